// Lattices in the graph of springs: nets of points in rows, whatever the order in which points and springs are listed.
#pragma once

#include "sim/plan/numbering/spring_graph.h"

namespace hooke {

// The points of a net row by row, from left to right.
using LatticePoints = std::vector<Index>;

// Finds nets that have springs along both threads, and none or the same diagonals in all cells, from the graph alone: from the four points
// of one cell, the place of those of the next one follows. Points and springs may be missing; nets may be closed to a tube. Those of fewer
// than min_lattice_points, and parts of the graph that have no such places, are left out. Disjoint; in ascending order of their smallest
// points.
std::vector<LatticePoints> find_lattices(const SpringGraph& graph);

}  // namespace hooke
