// Divides long passes over grids and points among the threads of a plan, to the same bits for any number of them.
#pragma once

#include <algorithm>
#include <array>

#include "sim/forces/grid_rows.h"
#include "sim/plan/plan.h"

namespace hooke {

inline constexpr int max_parts = 64;

// As many parts as the team of the plan has threads, but none shorter than `min_length`; one without a team, or while another thread uses
// it. Whoever runs the parts holds the turn.
inline int count_parts(const Plan& plan, const ThreadTeam::Turn& turn, Index length, Index min_length) {
  return turn ? std::clamp<int>(length / min_length, 1, std::min(plan.execution.team->size(), max_parts)) : 1;
}

// The start of a part; that of the part after the last one is `length`.
inline Index start_of_part(int part, int parts, Index length) {
  return static_cast<Index>(static_cast<std::int64_t>(length) * part / parts);
}

// Calls use(part, first, end) for parts of 0 .. length - 1, side by side; returns their number.
template <class Use>
int for_parts(const Plan& plan, Index length, Index min_length, const Use& use) {
  const ThreadTeam::Turn turn(plan.execution.team.get());
  const int parts = count_parts(plan, turn, length, min_length);
  if (parts == 1)
    use(0, Index{0}, length);
  else
    turn.run(parts, [&](int part) { use(part, start_of_part(part, parts, length), start_of_part(part + 1, parts, length)); });
  return parts;
}

// The first row of a band. All but the first band also compute the row above them for the forces that it exerts, and are a row shorter.
inline Index start_of_band(int band, int bands, Index rows) {
  return band == 0 ? 0 : start_of_part(band, bands, rows + bands - 1) - (band - 1);
}

// How many passes a thread over a band has begun and ended.
struct alignas(64) BandProgress {
  std::atomic<int> begun{0}, ended{0};
};

// `passes` passes over the rows of a grid, one after another, each in bands of rows side by side: use(part, pass, band). With `in_place`
// they change x and, with v, its velocities. Returns the number of bands. A thread begins a pass as soon as the band above has ended the
// one before.
template <class T, class Use>
int for_bands(const Plan& plan, const GridView<T>& grid, int passes, bool in_place, const T* x, const T* v, const Use& use) {
  constexpr Index min_points = 1000;  // some microseconds
  const ThreadTeam::Turn turn(plan.execution.team.get());
  const int max_bands = std::max(1, static_cast<int>(grid.rows / 2));
  const int bands = std::min(count_parts(plan, turn, grid.rows * grid.columns, min_points), max_bands);
  if (bands == 1) {
    for (int pass = 0; pass < passes; ++pass) use(0, pass, GridBand<T>{0, grid.rows});
    return 1;
  }

  // copies of the first row of each band but the first
  const std::size_t row = static_cast<std::size_t>(grid.columns), row_of_all = row * static_cast<std::size_t>(plan.dimensions);
  const std::size_t copy_size = (v != nullptr ? 2 : 1) * row_of_all;
  T* const copies = in_place ? reinterpret_cast<T*>(turn.scratch(copy_size * static_cast<std::size_t>(bands))) : nullptr;
  const auto copy_of = [&](int band) { return copies + static_cast<std::size_t>(band) * copy_size; };
  const auto copy_row = [&](const T* field, Index r, T* to) {
    for (int c = 0; c < plan.dimensions; ++c, to += row)
      std::copy_n(field + static_cast<std::size_t>(c) * grid.points + grid.first + static_cast<std::ptrdiff_t>(r) * grid.columns, row, to);
  };

  std::array<BandProgress, max_parts> progress;
  turn.run(bands, [&](int part) {
    GridBand<T> band{start_of_band(part, bands, grid.rows), start_of_band(part + 1, bands, grid.rows)};
    const bool is_last = part + 1 == bands;
    if (in_place && !is_last) {
      band.x_below = copy_of(part + 1);
      if (v != nullptr) band.v_below = copy_of(part + 1) + row_of_all;
    }
    for (int pass = 1; pass <= passes; ++pass) {
      const BandSteps steps{turn, progress[part].begun, is_last ? nullptr : &progress[part + 1].begun, pass};
      if (part > 0) turn.wait_for(progress[part - 1].ended, pass - 1);
      if (in_place) {
        if (part > 0) copy_row(x, band.begin, copy_of(part));
        if (part > 0 && v != nullptr) copy_row(v, band.begin, copy_of(part) + row_of_all);
        band.steps = &steps;
      }
      use(part, pass - 1, band);
      if (!is_last) ThreadTeam::Turn::set(progress[part].ended, pass);
    }
  });
  return bands;
}

}  // namespace hooke
