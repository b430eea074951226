// Rest lengths of springs by the points that they join.
#pragma once

#include <array>
#include <vector>

#include "sim/system.h"

namespace hooke {

class RestLengths {
 public:
  explicit RestLengths(const System& system);
  // [m], of the shortest spring that joins points i and j; 0: none with a length does.
  double between(Index i, Index j) const;

 private:
  struct Pair {
    std::array<Index, 2> ends{};  // the lower index first
    double length = 0.0;          // [m]
  };
  static std::array<Index, 2> ordered(Index i, Index j);

  std::vector<Pair> pairs_;  // in ascending order
};

}  // namespace hooke
