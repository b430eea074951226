// Contact between points, compiled for stepping: its constants, and the pairs of points that do not touch.
#pragma once

#include <array>
#include <vector>

#include "sim/model/system.h"

namespace hooke {

struct PairPlan {
  bool on = false;
  double thickness = 0.0;                    // [m], added to the sum of two radii
  double restitution = 0.0, friction = 0.0;  // [1]
  // Points joined by a spring that would touch at its rest length, such as neighbors in a cloth: the lower index first, sorted.
  std::vector<std::array<Index, 2>> joined;

  // Whether the points i < j are joined in this way.
  bool excludes(Index i, Index j) const;
};

PairPlan plan_pairs(const System& system);

}  // namespace hooke
