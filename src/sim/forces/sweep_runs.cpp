#include "sim/forces/sweep_runs.h"

#include "sim/plan/grid.h"

namespace hooke {

std::size_t place_runs(std::span<SweepRun> runs) {
  constexpr std::size_t lanes = Grid::lanes;
  std::size_t size = 0;
  for (SweepRun& run : runs) {
    // whole vectors, from cache lines on
    const std::size_t unit = run.count == 1 ? 1 : lanes * (run.step == 2 ? 2 : 1);
    if (unit > 1) size = (size + lanes - 1) / lanes * lanes;
    run.at = size;
    size += (run.place(run.count - 1) - run.at) / unit * unit + unit;
  }
  return size;
}

}  // namespace hooke
