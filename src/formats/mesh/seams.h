// Edges of a mesh that belong to one face only, and what almost joins them.
#pragma once

#include <array>
#include <vector>

#include "formats/mesh/clean_mesh.h"

namespace hooke {

// The sides that belong to one cell, with the smaller index first, sorted.
std::vector<std::array<Index, 2>> open_edges_of(const std::vector<Cell>& cells);

// Their ends, sorted.
std::vector<Index> vertices_of(const std::vector<std::array<Index, 2>>& edges);

struct Seams {
  double gap = 0.0;             // [m], about 1e-4 of the mean length of the open edges
  std::size_t points = 0;       // ends of open edges that are within the gap of another one
  std::size_t t_junctions = 0;  // ends of open edges that are within the gap of an open edge, between its ends
};

// T-junctions are counted in meshes with up to 100,000 open edges.
Seams find_seams(const CleanMesh& mesh);

}  // namespace hooke
