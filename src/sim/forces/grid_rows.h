// What kernels of grids read, in the precision of T: the grid with the numbers of its springs, its points, and bands of rows that threads
// compute side by side.
#pragma once

#include <array>

#include "base/threads/thread_team.h"
#include "sim/plan/grid.h"

namespace hooke {

// One number per cell, in rows `step` apart.
template <class T>
struct CellNumbers {
  const T* number = nullptr;
  std::size_t step = 0;
  const T* row(Index r) const { return number + static_cast<std::size_t>(r) * step; }
};

template <class T>
struct GridView {
  using CellNumbersOfEach = std::array<CellNumbers<T>, Grid::directions>;
  Index points = 0;  // of the scene: the distance of the components of a field
  Index first = 0, rows = 0, columns = 0;
  Index pitch = 0;  // columns rounded up to whole vectors
  CellNumbersOfEach stiffness, rest_length, damping;
};

// How a thread that advances the rows of a band stays in step with those of the bands beside it.
struct BandSteps {
  const ThreadTeam::Turn& turn;
  std::atomic<int>& own;
  const std::atomic<int>* below;  // null: this is the last band
  int pass;
  // The row above was read, and the copy of the first row was made: the band above may advance its last row.
  void has_read_above() const { ThreadTeam::Turn::set(own, pass); }
  // Returns when the band below has done so.
  void wait_for_below() const {
    if (below != nullptr) turn.wait_for(*below, pass);
  }
};

// The rows begin .. end - 1 of a grid, at least two. Other threads may advance the rows beside them at the same time: then the row `end` is
// read from copies of it as it was before the pass, component by component, of positions x and velocities v.
template <class T>
struct GridBand {
  Index begin = 0, end = 0;
  const T *x_below = nullptr, *v_below = nullptr;
  const BandSteps* steps = nullptr;  // null: the rows beside the band do not change
};

}  // namespace hooke
