// Edges that pass through faces in a scene whose faces touch: they do not touch each other until they are apart. And how much passes
// through each other, whatever touches.
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

// The number of edges that pass through faces or, in a flat scene, of pairs of springs of different parts (connected by springs) that
// cross; whether or not they are set to touch. O(n log n), in flat scenes times the number of springs beside each other.
long count_crossings(const System& system, const State& state);

// [m], by how much the spheres of two points overlap most, whether or not they are set to touch; 0 if none do.
double max_overlap(const System& system, const State& state);

}  // namespace hooke
