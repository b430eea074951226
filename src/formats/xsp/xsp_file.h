// Scenes of XSpringies 1.x (.xsp). The mapping keeps the motion: one pixel is one centimetre, so that lengths,
// velocities and gravity scale by 0.01, and stiffness, damping, mass and drag stay (docs/file-formats.md).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/scene_file.h"

namespace hooke {

inline constexpr double xsp_pixels_per_metre = 100.0;
// [pixels], of the window whose sides are the walls and whose middle draws: no file tells it.
inline constexpr double xsp_window_width = 640.0, xsp_window_height = 480.0;

// The scene of such a file, under a method and substeps that hold. Warns of what Hooke has nothing for. Throws InputError
// with the line that is wrong. `file` stands for it in messages and gives the scene's name.
LoadedScene parse_xsp(std::string_view text, const std::string& file);

// A two-dimensional scene as such a file, as it stands now: velocities are in it, the time is not. Appends to `lost`,
// one sentence each, what the format has no place for. Throws InputError for a scene in three dimensions. `file` stands for
// it in messages.
std::string format_xsp(const Scene& scene, const std::string& file, std::vector<std::string>& losses);

}  // namespace hooke
