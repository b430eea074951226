// Scenes of XSpringies 1.x (.xsp). The conversion preserves the motion: one pixel is one centimeter, so that lengths, velocities and
// gravity are scaled by 0.01, and stiffness, damping, mass and drag are unchanged (docs/reference/file-formats.md).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/scene_file.h"

namespace hooke {

inline constexpr double xsp_pixels_per_meter = 100.0;
// [pixels], the size of the window at the start of XSpringies, whose sides are the walls and whose middle is the center of forces; files do
// not contain it.
inline constexpr double xsp_window_width = 642.0, xsp_window_height = 550.0;

// [m], of a mass [kg] in XSpringies: walls act on the surface, and so does the pull of the center.
double xsp_radius(double mass, bool is_fixed);

// The scene of a file, with a stable method and number of substeps. Warns about what Hooke cannot represent. Throws InputError with the
// line of the error. `file` is its name in messages and gives the name of the scene.
LoadedScene parse_xsp(std::string_view text, const std::string& file);

// A 2-D scene as an .xsp file, in its current state: with velocities, without the time. Appends to `lost`, one sentence each, what the
// format cannot represent. Throws InputError for a 3-D scene. `file` is its name in messages.
std::string format_xsp(const Scene& scene, const std::string& file, std::vector<std::string>& losses);

}  // namespace hooke
