// Merges coincident vertices.
#pragma once

#include <span>
#include <vector>

#include "base/types.h"

namespace hooke {

// For each position, the index of the position it is welded to: the first kept position within `distance` [m], or its own index if there is
// none. The result is never further than `distance` from the position, so chains do not collapse. O(n log n).
std::vector<Index> weld(std::span<const Vec3> positions, double distance);

}  // namespace hooke
