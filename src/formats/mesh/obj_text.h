// Meshes in the Wavefront format (.obj).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/mesh/mesh.h"

namespace hooke {

// The vertices, polygons, lines and points of a file. Everything else is ignored, and no file that it refers to, such as materials, is
// opened. Appends what is ignored to `warnings`, one sentence each. Throws InputError with the line of the error: invalid coordinates,
// elements with missing vertices, more elements than file_limits.h allows. `file` is its name in messages.
Mesh parse_obj_text(std::string_view text, const std::string& file, std::vector<std::string>& warnings);

}  // namespace hooke
