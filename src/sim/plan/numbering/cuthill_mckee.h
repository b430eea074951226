// An order of points in which those joined by springs are close to each other.
#pragma once

#include "sim/plan/numbering/spring_graph.h"

namespace hooke {

// Appends the points that are not yet `done`, in the reverse order of E. Cuthill and J. McKee 1969 (A. George 1971): each part of the graph
// level by level from a point that is far from others.
void append_near_neighbors(const SpringGraph& graph, std::vector<char>& done, std::vector<Index>& order);

}  // namespace hooke
