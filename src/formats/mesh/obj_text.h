// Meshes in the Wavefront format (.obj), read with tinyobjloader.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/mesh/mesh.h"

namespace hooke {

// The vertices and polygons of such a file. Nothing else of it is used, and no file that it names is opened: materials
// above all. Appends to `warnings`, one sentence each, what is left out. Throws InputError with the line that is wrong:
// coordinates that are no numbers, polygons of vertices that are not there, more than file_limits.h allows. `file` stands
// for it in messages.
Mesh parse_obj_text(std::string_view text, const std::string& file, std::vector<std::string>& warnings);

}  // namespace hooke
