// The one style of the panels: colours, spacing, fonts. Made anew when the content scale changes.
#pragma once

#include <imgui.h>

#include "sim/system.h"

namespace hooke {

namespace palette {
inline constexpr ImU32 panel = IM_COL32(0x1a, 0x1d, 0x22, 255), raised = IM_COL32(0x26, 0x2b, 0x32, 255),
                       hovered = IM_COL32(0x31, 0x38, 0x41, 255), pressed = IM_COL32(0x3b, 0x44, 0x4f, 255),
                       line = IM_COL32(0x2e, 0x34, 0x3c, 255), box = IM_COL32(0x20, 0x24, 0x2a, 255),
                       text = IM_COL32(0xdc, 0xe1, 0xe7, 255), dim = IM_COL32(0x96, 0xa0, 0xac, 255),
                       accent = IM_COL32(0x5b, 0xc0, 0xb0, 255), tinted = IM_COL32(0x24, 0x46, 0x44, 255),
                       good = IM_COL32(0x74, 0xc2, 0x7a, 255), warning = IM_COL32(0xe6, 0xb4, 0x50, 255),
                       bad = IM_COL32(0xf0, 0x6a, 0x5c, 255), edge = IM_COL32(0x42, 0x4b, 0x56, 255),
                       shade = IM_COL32(0x12, 0x14, 0x18, 225);
}

struct Fonts {
  ImFont* body = nullptr;
  ImFont* small = nullptr;
  ImFont* strong = nullptr;
};

// Style and fonts for the current context: DejaVu Sans where it is installed, ImGui's own font elsewhere.
// `scale`: window units per unit of design; `density`: framebuffer pixels per window unit.
void load_theme(double scale, double density);

const Fonts& fonts();
// Window units for a length of the design.
float units(double length);

ImU32 to_imgui(Color color, int alpha = 255);

}  // namespace hooke
