// Edges that pass through faces in a scene whose faces touch: they do not touch each other until they are apart.
#pragma once

#include <array>
#include <vector>

#include "sim/state.h"
#include "sim/system.h"

namespace hooke {

// One entry of each list for every edge and face that cross.
struct CrossedParts {
  std::vector<std::array<PointId, 2>> edges;
  std::vector<std::array<PointId, 3>> faces;
  bool is_complete = true;  // false: so many parts are close to each other that the search ended
};

// Those of the present positions; none if faces do not touch. O(n log n).
CrossedParts find_crossed_parts(const System& system, const State& state);

}  // namespace hooke
