// A mesh made fit to be cloth: each place one point, each face a triangle or a quad that has an area and is there once.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "formats/mesh/mesh.h"

namespace hooke {

// A triangle or a quad. A quad is two triangles, cut from its first corner to its third.
struct Cell {
  std::array<Index, 4> corners{no_index, no_index, no_index, no_index};
  double area = 0.0;  // [m^2], > 0
  int size() const { return corners[3] == no_index ? 3 : 4; }
};

struct CleanMesh {
  std::vector<Vec3> points;  // [m], in the order of the mesh's vertices
  std::vector<Cell> cells;   // of points, in the mesh's order
  Vec3 min{0.0}, max{0.0};   // [m], about all vertices
  double size() const;       // [m], from corner to corner
};

// Vertices at one place (within a millionth of the mesh's size) are welded; faces without an area, faces that are there
// twice and vertices of no face are left out; polygons of more than four corners are cut into fans of triangles. What was
// done of all this is appended to `notes`, one sentence each. Throws InputError when no face is left. `file` stands for the
// mesh in messages.
CleanMesh clean_mesh(const Mesh& mesh, const std::string& file, std::vector<std::string>& notes);

}  // namespace hooke
