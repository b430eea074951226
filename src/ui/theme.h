// The one style of the panels: colours, spacing, fonts. Made anew when the content scale changes.
#pragma once

#include <imgui.h>

#include "sim/system.h"

namespace hooke {

// Of the look in use.
namespace palette {
inline ImU32 panel, raised, hovered, pressed, line, box, text, dim, accent, tinted, good, warning, bad, edge, shade, alarm, notice;
inline ImU32 axis_x, axis_y, axis_z;  // palette::panel is read on them
}  // namespace palette

enum class Look { Dark, Light };

// Sets the palette, and the style of the current context.
void use_look(Look look);
// What the scene stands before where it does not say so itself.
Color background_of(Look look);

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
