// Springs in the order in which a sweep over constraints visits them.
#pragma once

#include <cstddef>

#include "base/types.h"

namespace hooke {

// Springs that share no point. Spring n has the packed index begin + n step and connects points first + n step and second + n step,
// n = 0 .. count-1. With step 2 they are every other spring of a row, second = first + 1.
struct SweepRun {
  Index begin = 0, first = 0, second = 0, count = 0, step = 1;
  std::size_t at = 0;  // where the numbers of the run begin in lists with a number for each spring

  // Where the number of spring n is in such a list. Behind the numbers of several springs there is space for those of a vector.
  std::size_t place(Index n) const { return at + static_cast<std::size_t>(n) * (step == 2 ? 2 : 1); }
};

}  // namespace hooke
