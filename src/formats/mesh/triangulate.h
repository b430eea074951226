// Splits polygons into triangles.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/types.h"

namespace hooke {

// The triangles of a simple polygon in space, as indices of its corners in their order: n - 2 triangles that cover it once and use all
// corners. A hole may be joined to the outline by an edge that is passed twice. Returns false where
// there is no such set of triangles, because the polygon crosses itself: the triangles are then any. O(n^2).
bool triangulate(std::span<const Vec3> polygon, std::vector<std::array<Index, 3>>& triangles);

}  // namespace hooke
