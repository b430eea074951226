// Springs in the order in which a sweep over constraints visits them.
#pragma once

#include <algorithm>
#include <cstddef>

#include "sim/plan/plan.h"

namespace hooke {

// Springs that share no point. Spring n has the packed index begin + n step and connects points first + n step and second + n step,
// n = 0 .. count-1. With step 2 they are every other spring of a row, second = first + 1.
struct SweepRun {
  Index begin = 0, first = 0, second = 0, count = 0, step = 1;
  std::size_t at = 0;  // where the numbers of the run begin in lists with a number for each spring

  // Where the number of spring n is in such a list. Behind the numbers of several springs there is space for those of a vector.
  std::size_t place(Index n) const { return at + static_cast<std::size_t>(n) * (step == 2 ? 2 : 1); }
};

// The parts of a run in the order in which a sweep over dashpots visits them: every other spring of a row and then those between; of others
// as many at once as share no point. Their numbers are in lists in the order of the packed springs.
inline bool is_swept_as_row(const SpringRun& run) { return run.second - run.first == 1 && run.count > 1; }
inline Index count_sweep_parts(const SpringRun& run) {
  const Index stride = std::max(run.second - run.first, Index{1});
  return is_swept_as_row(run) ? 2 : (run.count + stride - 1) / stride;
}
inline SweepRun sweep_part(const SpringRun& run, Index part) {
  const bool is_row = is_swept_as_row(run);
  const Index stride = std::max(run.second - run.first, Index{1}), start = is_row ? part : part * stride;
  return {.begin = run.begin + start,
          .first = run.first + start,
          .second = run.second + start,
          .count = is_row ? (run.count + 1 - part) / 2 : std::min(stride, run.count - start),
          .step = is_row ? 2 : 1,
          .at = static_cast<std::size_t>(run.begin + start)};
}

}  // namespace hooke
