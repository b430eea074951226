// The colors of the strains, with numbers.
#pragma once

#include <imgui.h>

#include "ui/panels.h"

namespace hooke {

inline constexpr double strain_legend_height = 48.0;  // [design units]

// Whether strains are shown as colors.
bool shows_strain_colors(const System& system, const ViewOptions& view);
// With its upper left corner at `at` and this width, both in window units.
void draw_strain_legend(const Snapshot& snapshot, ImVec2 at, float width, ImDrawList& list);
// In one line.
void draw_strain_legend(const Snapshot& snapshot, const Rect& strip, ImDrawList& list);

}  // namespace hooke
