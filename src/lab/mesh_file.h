// Meshes as files: .obj is read as cloth and written, .ply is written.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lab/scene_file.h"

namespace hooke {

// Cloth from a mesh in the Wavefront format (mesh_cloth.h), under a method and substeps that hold. Warns of what was
// mended or left out. Throws Refused with the line that is wrong. `file` stands for it in messages and gives the scene's
// name.
LoadedScene parse_obj(std::string_view text, const std::string& file);

// A way to write the scene's surface as it stands now: all points are vertices, in order, faces are faces, springs with
// an end that belongs to no face are lines. Coordinates in metres, y as in the scene.
struct MeshFormat {
  std::string_view extension;  // ".obj"
  std::string_view label;
  std::string (*format)(const Scene& scene);
};
std::span<const MeshFormat> mesh_formats();

// The row with this extension, or null.
const MeshFormat* find_mesh_format(std::string_view extension);

// The mean strain l / l0 - 1 [1] of the springs at each point, those without a rest length left out; 0 where there are none.
std::vector<double> strain_of_points(const Scene& scene);

}  // namespace hooke
