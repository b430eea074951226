// Meshes as files: .obj is read as cloth and written, .ply is written.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/import_options.h"
#include "formats/scene_file.h"

namespace hooke {

// Cloth from a mesh in the Wavefront format (mesh_cloth.h), with a stable method and number of substeps. Warns about everything that was
// repaired or ignored. Throws InputError with the line of the error. `file` is its name in messages and gives the name of the scene.
LoadedScene parse_obj(std::string_view text, const std::string& file, const ImportOptions& options = {});

// The current surface of the scene in the Wavefront format: all points are vertices, in order; springs that the faces do not stand for are
// lines: with an end that belongs to no face, or along the threads but not along a face. Coordinates in meters, y as in the scene. What is
// written is read back as the same points, faces and lines.
std::string format_obj(const Scene& scene);

// The same in the Stanford format, binary, with the strain of each vertex (strain_of_points).
std::string format_ply(const Scene& scene);

// The mean strain l / l0 - 1 [1] of the springs at each point, ignoring those without rest length; 0 if there are none.
std::vector<double> strain_of_points(const Scene& scene);

}  // namespace hooke
