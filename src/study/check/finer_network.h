// The same sheets and ropes with twice the resolution: how far a result depends on the number of points.
#pragma once

#include <optional>

#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

struct FinerNetwork {
  System system;
  State state;
  Index sheets = 0, ropes = 0;  // that were refined
};

// Cuts each spring of a sheet or rope into two halves and each cell of a sheet into four. New points lie between their neighbors, with the
// mean of their velocities. What a sheet or rope is made of stays the same:
//   rope    half the mass per point and twice the k and d per spring; a load on a point stays there;
//   sheet   a quarter of the mass per point and the same k and d, because twice as many springs of half the length lie side by side; what
//           exceeds this along a border counts as a cord in it, which is refined like a rope;
//   bend springs (to the second next point) as springs of a sheet: stretching the sheet takes the same force, bending it does not.
// The radius of a point, with which it touches colliders, stays the same. Other points and springs are copied. All points keep their ids.
// A sheet is a grid of at least 4 columns and 2 rows, a rope a row of at least 8 points, numbered row by row, with other springs on at most
// a quarter of their points; trusses and lattices are neither. None if there is no sheet or rope, or if it would have more than
// `max_points`.
std::optional<FinerNetwork> refine_network(const System& system, const State& state, Index max_points);

}  // namespace hooke
