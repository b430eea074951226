// Rest lengths of springs by the points that they join.
#pragma once

#include <array>
#include <vector>

#include "sim/model/system.h"

namespace hooke {

// The points of an edge in ascending order.
using EdgeEnds = std::array<Index, 2>;
inline EdgeEnds edge_ends(Index i, Index j) { return i < j ? EdgeEnds{i, j} : EdgeEnds{j, i}; }

class RestLengths {
 public:
  explicit RestLengths(const System& system);
  // [m], of the shortest spring that joins points i and j; 0: none with a length does.
  double between(Index i, Index j) const;

 private:
  struct Pair {
    EdgeEnds ends{};
    double length = 0.0;  // [m]
  };
  std::vector<Pair> pairs_;  // in ascending order
};

}  // namespace hooke
