// p = k (1 - l0 / l) + d (w . u) / l^2,  f = -p u on the first end of a spring, +p u on the second; u = x1 - x2, w = v1 - v2, l = |u|,
// and p = 0 at l = 0.
//
//   x00 --R-- x01     A vector of cells (r, j), (r, j+1), .. loads the corners of its cells once and computes the four springs
//    | \     /        that a cell owns. The sum for its own corner x00 takes what the cell to its left has for it, moved up by
//    D   G  A         one lane, and what the row above has, from a buffer of one row. The force on row r is then complete, and
//    | /     \        no other spring needs its old position: the point can be advanced in place.
//   x10       x11
//
// Compiled once for each vector unit by Highway. Every lane does the same IEEE operations in every width, and every point has the
// same order of sums: ((R - A of its left) - (R + D + G)) + ((D + A) + G of its left, all of the row above), signs as on it.
#include "sim/forces/grid_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/forces/grid_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "sim/forces/grid_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <int Dimensions, bool Damped>
void add_forces(const GridView<double>& grid, const GridBand<double>& band, const double* x, const double* v, double* f) {
  compute_band<Dimensions, Damped>(grid, band, x, v, [&](const auto& columns, Index i, const auto* force) HWY_ATTR {
    for (int c = 0; c < Dimensions; ++c) {
      double* const sum = f + static_cast<std::size_t>(c) * grid.points + i;
      columns.store(hn::Add(columns.load(sum), force[c]), sum);
    }
  });
}

// Advances the points i, i + 1, .. on which the grid exerts `force`; with Known, a is read.
template <int Dimensions, bool Known, class T, class Columns, class V>
HWY_INLINE void advance_columns(const LeapfrogPass<T>& pass, const Columns& columns, Index i, const V* force) {
  const auto d = columns.d;
  const V inverse_mass = columns.load(pass.inverse_mass + i);
  const auto is_fixed = hn::Eq(inverse_mass, hn::Zero(d));
  for (int c = 0; c < Dimensions; ++c) {
    const std::size_t at = static_cast<std::size_t>(c) * pass.stride + i;
    V a;
    if constexpr (Known)
      a = columns.load(pass.a + at);
    else
      a = pass.f == nullptr ? hn::Add(hn::Set(d, pass.acceleration[c]), hn::Mul(inverse_mass, force[c]))
                            : hn::Mul(inverse_mass, hn::Add(columns.load(pass.f + at), force[c]));
    if (!Known && pass.a != nullptr) columns.store(hn::IfThenZeroElse(is_fixed, a), pass.a + at);
    if (pass.v == nullptr) continue;
    const V before = columns.load(pass.v + at);
    const V kicked = hn::Add(hn::Mul(hn::Set(d, pass.kick.decay), before), hn::Mul(hn::Set(d, pass.kick.weight), a));
    const V after = hn::IfThenElse(is_fixed, before, kicked);
    columns.store(after, pass.v + at);
    if (pass.w != nullptr) {
      const V predicted = hn::Add(hn::Mul(hn::Set(d, pass.prediction.decay), after), hn::Mul(hn::Set(d, pass.prediction.weight), a));
      columns.store(hn::IfThenElse(is_fixed, before, predicted), pass.w + at);
    }
    if (pass.drifted != nullptr)
      columns.store(hn::Add(columns.load(pass.x + at), hn::Mul(hn::Set(d, pass.drift), after)), pass.drifted + at);
  }
}

template <int Dimensions, bool Damped, class T>
void advance(const GridView<T>& grid, const GridBand<T>& band, const LeapfrogPass<T>& pass) {
  compute_band<Dimensions, Damped>(grid, band, pass.x, pass.u, [&](const auto& columns, Index i, const auto* force) HWY_ATTR {
    advance_columns<Dimensions, false>(pass, columns, i, force);
  });
}

template <int Dimensions, bool Known, class T>
void advance_each(Index first, Index end, const LeapfrogPass<T>& pass) {
  const WholeVector<hn::ScalableTag<T>> whole{};
  const Index lanes = static_cast<Index>(hn::Lanes(whole.d));
  const OneColumn<T> one{{}, false};
  const auto advance_at = [&](const auto& columns, Index i) HWY_ATTR {
    using V = typename std::remove_cvref_t<decltype(columns)>::V;
    V force[Dimensions];
    for (V& component : force) component = hn::Zero(columns.d);
    advance_columns<Dimensions, Known>(pass, columns, i, force);
  };
  Index i = first;
  for (; i + lanes <= end; i += lanes) advance_at(whole, i);
  for (; i < end; ++i) advance_at(one, i);
}

void add_band(int dimensions, const GridView<double>& grid, const GridBand<double>& band, const double* x, const double* v, double* f) {
  if (dimensions == 2)
    v != nullptr ? add_forces<2, true>(grid, band, x, v, f) : add_forces<2, false>(grid, band, x, v, f);
  else
    v != nullptr ? add_forces<3, true>(grid, band, x, v, f) : add_forces<3, false>(grid, band, x, v, f);
}
void advance_band(const GridView<double>& grid, const GridBand<double>& band, const LeapfrogPass<double>& pass) {
  if (pass.dimensions == 2)
    pass.u != nullptr ? advance<2, true>(grid, band, pass) : advance<2, false>(grid, band, pass);
  else
    pass.u != nullptr ? advance<3, true>(grid, band, pass) : advance<3, false>(grid, band, pass);
}
void advance_single_band(const GridView<float>& grid, const GridBand<float>& band, const LeapfrogPass<float>& pass) {
  pass.dimensions == 2 ? advance<2, false>(grid, band, pass) : advance<3, false>(grid, band, pass);
}
void advance_part(Index first, Index end, const LeapfrogPass<double>& pass) {
  pass.dimensions == 2 ? advance_each<2, false>(first, end, pass) : advance_each<3, false>(first, end, pass);
}
void advance_single_part(Index first, Index end, const LeapfrogPass<float>& pass) {
  pass.dimensions == 2 ? advance_each<2, false>(first, end, pass) : advance_each<3, false>(first, end, pass);
}
void advance_known_part(Index first, Index end, const LeapfrogPass<double>& pass) {
  pass.dimensions == 2 ? advance_each<2, true>(first, end, pass) : advance_each<3, true>(first, end, pass);
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <ranges>

#include "sim/forces/bands.h"

namespace hooke {

HWY_EXPORT(add_band);
HWY_EXPORT(advance_band);
HWY_EXPORT(advance_single_band);
HWY_EXPORT(advance_part);
HWY_EXPORT(advance_single_part);
HWY_EXPORT(advance_known_part);

namespace {

constexpr Index min_points_of_part = 4000;  // some microseconds

GridView<double> view_of(const Plan& plan, const Grid& grid) {
  GridView<double> view{.points = plan.points, .first = grid.first, .rows = grid.rows, .columns = grid.columns, .pitch = grid.pitch()};
  const auto set = [](const auto& values, auto& numbers) {
    for (std::size_t direction = 0; direction < Grid::directions; ++direction)
      numbers[direction] = {values[direction].number.data(), values[direction].row_step};
  };
  set(grid.stiffness, view.stiffness);
  set(grid.rest_length, view.rest_length);
  set(grid.damping, view.damping);
  return view;
}

// Grids do not act on each other: advance_band(grid, band, pass) for each, and advance_part(first, end, pass) for the points outside.
template <class T, class Grids, class AdvanceBand, class AdvancePart>
void advance_all(const Plan& plan, const Grids& grids, const LeapfrogPass<T>& pass, int count, const AdvanceBand& advance_band,
                 const AdvancePart& advance_part) {
  const bool in_place = pass.v != nullptr && (pass.drifted != nullptr || pass.u == pass.v || (pass.u != nullptr && pass.u == pass.w));
  Index next = 0;
  const auto advance_until = [&](Index end) {
    for (int i = 0; i < count && next < end; ++i)
      for_parts(plan, end - next, min_points_of_part,
                [&](int, Index begin_of_part, Index end_of_part) { advance_part(next + begin_of_part, next + end_of_part, pass); });
  };
  for (const GridView<T>& grid : grids) {
    advance_until(grid.first);
    for_bands(plan, grid, count, in_place, pass.x, pass.u, [&](int, int, const GridBand<T>& band) { advance_band(grid, band, pass); });
    next = grid.first + grid.rows * grid.columns;
  }
  advance_until(plan.points);
}

}  // namespace

LeapfrogPass<double> pass_over(const Plan& plan, const Field& x) {
  const Vec3& g = plan.acceleration;
  return {.dimensions = plan.dimensions,
          .stride = plan.points,
          .inverse_mass = plan.inverse_mass.data(),
          .acceleration = {g.x, g.y, g.z},
          .x = x.data()};
}

void add_grid_forces(const Plan& plan, const Grid& grid, const double* x, const double* v, double* f) {
  const GridView<double> view = view_of(plan, grid);
  for_bands(plan, view, 1, false, x, v, [&](int, int, const GridBand<double>& band) {
    HWY_DYNAMIC_DISPATCH(add_band)(plan.dimensions, view, band, x, v, f);
  });
}

void advance(const Plan& plan, const LeapfrogPass<double>& pass, int count) {
  const auto views = std::views::transform(plan.spring.grids, [&](const Grid& grid) { return view_of(plan, grid); });
  advance_all(
      plan, views, pass, count,
      [](const auto& view, const auto& band, const auto& each) {
        HWY_DYNAMIC_DISPATCH(advance_band)
        (view, band, each);
      },
      [](Index first, Index end, const auto& each) {
        HWY_DYNAMIC_DISPATCH(advance_part)
        (first, end, each);
      });
}

void advance(const Plan& plan, std::span<const GridView<float>> grids, const LeapfrogPass<float>& pass, int count) {
  advance_all(
      plan, grids, pass, count,
      [](const auto& view, const auto& band, const auto& each) {
        HWY_DYNAMIC_DISPATCH(advance_single_band)
        (view, band, each);
      },
      [](Index first, Index end, const auto& each) {
        HWY_DYNAMIC_DISPATCH(advance_single_part)
        (first, end, each);
      });
}

void advance_with_known(const Plan& plan, const LeapfrogPass<double>& pass) {
  for_parts(plan, plan.points, min_points_of_part, [&](int, Index first, Index end) {
    HWY_DYNAMIC_DISPATCH(advance_known_part)(first, end, pass);
  });
}

}  // namespace hooke
#endif
