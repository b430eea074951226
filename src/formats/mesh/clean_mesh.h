// A mesh prepared for conversion to cloth: one point per position, each face a unique triangle or quad with an area, each line unique and
// with a length.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "formats/mesh/mesh.h"

namespace hooke {

// A triangle or a quad. A quad is two triangles, split from its first corner to its third.
struct Cell {
  std::array<Index, 4> corners{no_index, no_index, no_index, no_index};
  double area = 0.0;  // [m^2], > 0
  int size() const { return corners[3] == no_index ? 3 : 4; }
};

struct CleanMesh {
  std::vector<Vec3> points;                 // [m], in the order of the mesh's vertices
  std::vector<Cell> cells;                  // of points, in the mesh's order
  std::vector<std::array<Index, 2>> lines;  // of points, in the mesh's order
  Vec3 min{0.0}, max{0.0};                  // bounding box of the points
  double size() const;                      // [m], its diagonal
};

// Welds coincident vertices (within a millionth of the size of the mesh), and vertices of open edges that are closer than `seam_distance`
// [m]; ignores faces without area, duplicate faces and lines, and vertices that no face, line or point uses; splits polygons with more than
// four corners into triangles. Appends what was changed to `notes`, one sentence each, and what may be unintended: open edges that almost
// coincide, and a size that suggests another unit. Throws InputError if nothing is left. `file` is the name of the mesh in messages.
CleanMesh clean_mesh(const Mesh& mesh, double seam_distance, const std::string& file, std::vector<std::string>& notes);

// "1 x 2 x 0.5 m"
std::string format_size(const Vec3& size);

}  // namespace hooke
