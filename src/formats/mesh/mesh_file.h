// Meshes as files: .obj is read as cloth and written, .ply is written.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/scene_file.h"

namespace hooke {

// Cloth from a mesh in the Wavefront format (mesh_cloth.h), under a method and substeps that hold. Warns of what was
// mended or left out. Throws InputError with the line that is wrong. `file` stands for it in messages and gives the scene's
// name.
LoadedScene parse_obj(std::string_view text, const std::string& file);

// The scene's surface as it stands now, in the Wavefront format: all points are vertices, in order, faces are faces,
// springs with an end that belongs to no face are lines. Coordinates in metres, y as in the scene.
std::string format_obj(const Scene& scene);

// The same in the Stanford format, binary, with the strain of each vertex (strain_of_points).
std::string format_ply(const Scene& scene);

// The mean strain l / l0 - 1 [1] of the springs at each point, those without a rest length left out; 0 where there are none.
std::vector<double> strain_of_points(const Scene& scene);

}  // namespace hooke
