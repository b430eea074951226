// Vertices that are one and were written down twice.
#pragma once

#include <span>
#include <vector>

#include "base/types.h"

namespace hooke {

// For each position the index of the one it is welded to: the first, in order, of those that stand for themselves and lie
// within `distance` [m]; its own index when there is none. What is welded lies no further than that from where it goes,
// chains included. O(n log n). At most 2^20 distances may lie between any two along an axis.
std::vector<Index> weld(std::span<const Vec3> positions, double distance);

}  // namespace hooke
