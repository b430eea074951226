// The style of the panels: colors, spacing, fonts. It is reloaded when the content scale changes.
#pragma once

#include <imgui.h>

#include <string>
#include <string_view>

#include "sim/model/system.h"

namespace hooke {

// Colors of the current theme.
namespace palette {
inline ImU32 panel, raised, hovered, pressed, line, box, text, dim, accent, tinted, good, warning, bad, edge, shade, alarm, notice;
inline ImU32 axis_x, axis_y, axis_z;  // their labels are drawn in palette::panel
inline ImU32 inks[6];                 // of the lines in a plot, in this order
}  // namespace palette

enum class Look { Dark, Light };

// Sets the palette, and the style of the current context.
void use_look(Look look);
// Background of a scene that does not define one.
Color background_of(Look look);

struct Fonts {
  ImFont* body = nullptr;
  ImFont* small = nullptr;
  ImFont* strong = nullptr;
};

// Loads style and fonts into the current context: DejaVu Sans if it is installed, otherwise the built-in font of ImGui. `scale`: window
// units per design unit; `density`: framebuffer pixels per window unit.
void load_theme(double scale, double density);

// Takes note of the Chinese, Japanese and Korean characters of a text that is shown, for the next `load_theme`; whether some are not
// loaded.
void follow_text(std::string_view text);
bool needs_fonts();
// What to install for these characters or because there is no DejaVu Sans, each returned once; empty: nothing.
std::string missing_font();

const Fonts& fonts();
// Converts design units to window units.
float units(double length);

ImU32 to_imgui(Color color, int alpha = 255);
Color to_color(ImU32 packed);

}  // namespace hooke
