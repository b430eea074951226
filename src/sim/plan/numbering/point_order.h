// The order of points in which a scene is stepped: that of the System, or one in which its nets are grids (grid.h).
#pragma once

#include <span>
#include <vector>

#include "sim/model/rest_lengths.h"

namespace hooke {

// The points of the System in the order of the Plan. Empty: as listed, because most springs already join points as many numbers apart as
// many others do, or because no order was found that is much better. Depends on the springs and their families alone. O(springs log
// springs).
std::vector<Index> choose_point_order(const System& system, std::span<const EdgeEnds> ends);

// How fast springs are stepped in an order of points.
struct OrderQuality {
  double regular = 0.0;   // [1], part of the springs that join points as many numbers apart as many others do: of grids, of long runs
  double distance = 0.0;  // mean difference of the numbers of both ends
};
// `number`: of each point in the order; empty: as listed.
OrderQuality measure_order(Index points, std::span<const EdgeEnds> ends, std::span<const Index> number);

}  // namespace hooke
