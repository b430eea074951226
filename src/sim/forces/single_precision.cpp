#include "sim/forces/single_precision.h"

#include <algorithm>

#include "sim/forces/grid_kernel.h"

namespace hooke {
namespace {

constexpr Index single_lanes = 16;  // of the widest vectors

Index round_up(Index count) { return (count + single_lanes - 1) / single_lanes * single_lanes; }

}  // namespace

GridView<float>::CellNumbersOfEach SinglePrecision::Values::set(const std::array<Grid::Values, Grid::directions>& values, const Grid& grid,
                                                                Index pitch) {
  GridView<float>::CellNumbersOfEach numbers;
  for (std::size_t direction = 0; direction < Grid::directions; ++direction) {
    const Grid::Values& from = values[direction];
    // the last row has springs to the right only
    const Index rows = from.row_step == 0 ? 1 : grid.rows - (direction == Grid::Right ? 0 : 1);
    std::vector<float>& to = number[direction];
    to.assign(static_cast<std::size_t>(rows) * pitch, 0.0f);
    for (Index r = 0; r < rows; ++r)
      std::transform(from.row(r), from.row(r) + grid.columns, to.data() + static_cast<std::size_t>(r) * pitch,
                     [](double value) { return static_cast<float>(value); });
    numbers[direction] = {to.data(), from.row_step == 0 ? 0 : static_cast<std::size_t>(pitch)};
  }
  return numbers;
}

GridView<float> SinglePrecision::view_of(const Grid& grid, Numbers& numbers) const {
  GridView<float> view{.points = pitch_, .first = grid.first, .rows = grid.rows, .columns = grid.columns, .pitch = round_up(grid.columns)};
  view.stiffness = numbers.stiffness.set(grid.stiffness, grid, view.pitch);
  view.rest_length = numbers.rest_length.set(grid.rest_length, grid, view.pitch);
  return view;
}

void SinglePrecision::load(const Plan& plan, const Motion& motion) {
  const auto n = static_cast<std::size_t>(plan.points);
  pitch_ = round_up(plan.points);
  for (std::vector<float>* field : {&x_, &v_}) field->resize(static_cast<std::size_t>(plan.dimensions) * pitch_);
  inverse_mass_.resize(n);
  std::ranges::transform(plan.inverse_mass, inverse_mass_.begin(), [](double value) { return static_cast<float>(value); });
  for (int c = 0; c < plan.dimensions; ++c) {
    const double *x = motion.x.data() + c * n, *v = motion.v.data() + c * n;
    const auto [min, max] = std::minmax_element(x, x + n);
    const double origin = origin_[c] = 0.5 * (*min + *max);
    float* const single_x = x_.data() + static_cast<std::size_t>(c) * pitch_;
    std::transform(x, x + n, single_x, [origin](double value) { return static_cast<float>(value - origin); });
    std::transform(v, v + n, v_.data() + static_cast<std::size_t>(c) * pitch_, [](double value) { return static_cast<float>(value); });
  }
}

// Fixed points keep their bits.
void SinglePrecision::store(const Plan& plan, Motion& motion) const {
  const auto n = static_cast<std::size_t>(plan.points);
  for (int c = 0; c < plan.dimensions; ++c)
    for (std::size_t i = 0; i < n; ++i) {
      if (plan.inverse_mass[i] == 0.0) continue;
      motion.x[c * n + i] = origin_[c] + static_cast<double>(x_[static_cast<std::size_t>(c) * pitch_ + i]);
      motion.v[c * n + i] = static_cast<double>(v_[static_cast<std::size_t>(c) * pitch_ + i]);
    }
}

void SinglePrecision::advance(const Plan& plan, const LeapfrogPass<double>& pass, int steps, Motion& motion) {
  load(plan, motion);
  numbers_.resize(plan.spring.grids.size());
  views_.resize(plan.spring.grids.size());
  for (std::size_t g = 0; g < plan.spring.grids.size(); ++g) views_[g] = view_of(plan.spring.grids[g], numbers_[g]);
  LeapfrogPass<float> single{.dimensions = plan.dimensions,
                             .stride = pitch_,
                             .inverse_mass = inverse_mass_.data(),
                             .x = x_.data(),
                             .drifted = x_.data(),
                             .v = v_.data(),
                             .kick = {static_cast<float>(pass.kick.decay), static_cast<float>(pass.kick.weight)},
                             .drift = static_cast<float>(pass.drift)};
  for (int c = 0; c < plan.dimensions; ++c) single.acceleration[c] = static_cast<float>(pass.acceleration[c]);
  hooke::advance(plan, views_, single, steps);
  store(plan, motion);
}

}  // namespace hooke
