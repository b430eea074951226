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

#include <algorithm>
#include <type_traits>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/forces/grid_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "sim/forces/grid_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

struct NoOthers {
  template <class Columns, class V>
  HWY_INLINE V operator()(const Columns&, Index, int, V from_above) const {
    return from_above;
  }
};

// The buffer of a band, whose forces are zero.
HWY_INLINE Scratch<double> empty_scratch(double* buffer, const GridView<double>& grid) {
  const Scratch<double> scratch(buffer, grid.pitch);
  for (double* row : scratch.force)
    for (Index j = 0; j < grid.pitch; ++j) row[j] = 0.0;
  return scratch;
}

template <int Dimensions, bool Damped>
void add_forces(const Plan& plan, const GridView<double>& grid, const GridBand<double>& band, const double* x, const double* v, double* f) {
  HWY_ALIGN double buffer[scratch_rows * Grid::max_columns];
  AnySet<double> at_limit;
  compute_band<Dimensions, Damped, false>(grid, band, x, v, empty_scratch(buffer, grid), f, at_limit, NoOthers(),
                                          [&](const auto& columns, Index i, const auto* on_points) HWY_ATTR {
                                            for (int c = 0; c < Dimensions; ++c)
                                              columns.store(on_points[c], f + static_cast<std::size_t>(c) * plan.points + i);
                                          });
}

// All forces but those of grids, f or else gravity, and what the row above exerts.
template <class Columns, class V>
HWY_INLINE V add_others(const Plan& plan, const double* f, const Columns& columns, Index i, int c, V from_above) {
  const V others = f == nullptr ? hn::Mul(hn::Set(columns.d, plan.acceleration[c]), columns.load(plan.mass.data() + i))
                                : columns.load(f + static_cast<std::size_t>(c) * plan.points + i);
  return hn::Add(others, from_above);
}

template <int Dimensions, bool Damped>
void accelerate(const Plan& plan, const GridView<double>& grid, const GridBand<double>& band, const double* x, const double* v,
                const double* f, double* a) {
  HWY_ALIGN double buffer[scratch_rows * Grid::max_columns];
  AnySet<double> at_limit;
  const auto others = [&](const auto& columns, Index i, int c, auto from_above)
                          HWY_ATTR { return add_others(plan, f, columns, i, c, from_above); };
  compute_band<Dimensions, Damped, true>(grid, band, x, v, empty_scratch(buffer, grid), static_cast<double*>(nullptr), at_limit, others,
                                         [&](const auto& columns, Index i, const auto* force) HWY_ATTR {
                                           const auto inverse_mass = columns.load(plan.inverse_mass.data() + i);
                                           for (int c = 0; c < Dimensions; ++c)
                                             columns.store(hn::Mul(inverse_mass, force[c]),
                                                           a + static_cast<std::size_t>(c) * plan.points + i);
                                         });
}

// Advances the points i, i + 1, .. on which the grid exerts `force`, or with IsSum all forces; the square of their speed then.
template <int Dimensions, bool IsSum, class Columns, class V>
HWY_INLINE V advance_columns(const Plan& plan, const GridPass& pass, double* x, double* v, const Columns& columns, Index i,
                             const V* force) {
  const auto d = columns.d;
  const V inverse_mass = columns.load(plan.inverse_mass.data() + i);
  const auto is_fixed = hn::Eq(inverse_mass, hn::Zero(d));
  V square = hn::Zero(d);
  for (int c = 0; c < Dimensions; ++c) {
    const std::size_t at = static_cast<std::size_t>(c) * plan.points + i;
    V a;
    if constexpr (IsSum) {
      a = hn::Mul(inverse_mass, force[c]);
      columns.store(a, pass.a + at);
    } else if (pass.is_known) {
      a = columns.load(pass.a + at);
    } else {
      a = pass.f == nullptr ? hn::Add(hn::Set(d, plan.acceleration[c]), hn::Mul(inverse_mass, force[c]))
                            : hn::Mul(inverse_mass, hn::Add(columns.load(pass.f + at), force[c]));
    }
    const V before = columns.load(v + at);
    const V kicked = hn::Add(hn::Mul(hn::Set(d, pass.decay), before), hn::Mul(hn::Set(d, pass.weight), a));
    const V after = hn::IfThenElse(is_fixed, before, kicked);
    columns.store(after, v + at);
    if (pass.predicted != nullptr) {
      const V predicted = hn::Add(hn::Mul(hn::Set(d, pass.predicted_decay), after), hn::Mul(hn::Set(d, pass.predicted_weight), a));
      columns.store(hn::IfThenElse(is_fixed, before, predicted), pass.predicted + at);
    }
    if (pass.drift != 0.0) columns.store(hn::Add(columns.load(x + at), hn::Mul(hn::Set(d, pass.drift), after)), x + at);
    square = hn::Add(square, hn::Mul(after, after));
  }
  return columns.valid(square);
}

template <int Dimensions, bool Damped, bool IsSum>
void advance(const Plan& plan, const GridView<double>& grid, const GridBand<double>& band, const GridPass& pass, double* x, double* v,
             GridWatch& watch) {
  HWY_ALIGN double buffer[scratch_rows * Grid::max_columns];
  AnySet<double> at_limit;
  Max<double> max_square;
  const auto others = [&](const auto& columns, Index i, int c, auto from_above) HWY_ATTR {
    if constexpr (IsSum)
      return add_others(plan, pass.f, columns, i, c, from_above);
    else
      return from_above;
  };
  const double* const dashpot_velocity = pass.dashpot_velocity != nullptr ? pass.dashpot_velocity : v;
  compute_band<Dimensions, Damped, true>(grid, band, x, dashpot_velocity, empty_scratch(buffer, grid), static_cast<double*>(nullptr),
                                         at_limit, others, [&](const auto& columns, Index i, const auto* force) HWY_ATTR {
                                           max_square.add(advance_columns<Dimensions, IsSum>(plan, pass, x, v, columns, i, force));
                                         });
  watch.max_speed_squared = std::max(watch.max_speed_squared, max_square.get());
  watch.any_at_limit = watch.any_at_limit || at_limit.any();
}

template <int Dimensions, bool IsSum>
void advance_each(const Plan& plan, Index first, Index end, const GridPass& pass, double* x, double* v, GridWatch& watch) {
  const WholeVector<hn::ScalableTag<double>> whole{};
  const Index lanes = static_cast<Index>(hn::Lanes(whole.d));
  const OneColumn<double> one{{}, false};
  Max<double> max_square;
  const auto advance_at = [&](const auto& columns, Index i) HWY_ATTR {
    using V = typename std::remove_cvref_t<decltype(columns)>::V;
    V force[Dimensions];
    for (int c = 0; c < Dimensions; ++c) {
      force[c] = hn::Zero(columns.d);
      if constexpr (IsSum) force[c] = add_others(plan, pass.f, columns, i, c, force[c]);
    }
    max_square.add(advance_columns<Dimensions, IsSum>(plan, pass, x, v, columns, i, force));
  };
  Index i = first;
  for (; i + lanes <= end; i += lanes) advance_at(whole, i);
  for (; i < end; ++i) advance_at(one, i);
  watch.max_speed_squared = std::max(watch.max_speed_squared, max_square.get());
}

template <int Dimensions>
void advance_any(const Plan& plan, const GridView<double>& grid, const GridBand<double>& band, const GridPass& pass, double* x, double* v,
                 GridWatch& watch) {
  if (pass.a != nullptr && !pass.is_known)
    pass.damped ? advance<Dimensions, true, true>(plan, grid, band, pass, x, v, watch)
                : advance<Dimensions, false, true>(plan, grid, band, pass, x, v, watch);
  else
    pass.damped ? advance<Dimensions, true, false>(plan, grid, band, pass, x, v, watch)
                : advance<Dimensions, false, false>(plan, grid, band, pass, x, v, watch);
}

template <int Dimensions>
void advance_any_each(const Plan& plan, Index first, Index end, const GridPass& pass, double* x, double* v, GridWatch& watch) {
  pass.a != nullptr && !pass.is_known ? advance_each<Dimensions, true>(plan, first, end, pass, x, v, watch)
                                      : advance_each<Dimensions, false>(plan, first, end, pass, x, v, watch);
}

void add_band(const Plan& plan, const GridView<double>& grid, const GridBand<double>& band, const double* x, const double* v, double* f) {
  if (plan.dimensions == 2)
    v != nullptr ? add_forces<2, true>(plan, grid, band, x, v, f) : add_forces<2, false>(plan, grid, band, x, v, f);
  else
    v != nullptr ? add_forces<3, true>(plan, grid, band, x, v, f) : add_forces<3, false>(plan, grid, band, x, v, f);
}
void accelerate_band(const Plan& plan, const GridView<double>& grid, const GridBand<double>& band, const double* x, const double* v,
                     const double* f, double* a) {
  if (plan.dimensions == 2)
    v != nullptr ? accelerate<2, true>(plan, grid, band, x, v, f, a) : accelerate<2, false>(plan, grid, band, x, v, f, a);
  else
    v != nullptr ? accelerate<3, true>(plan, grid, band, x, v, f, a) : accelerate<3, false>(plan, grid, band, x, v, f, a);
}
void advance_band(const Plan& plan, const GridView<double>& grid, const GridBand<double>& band, const GridPass& pass, double* x, double* v,
                  GridWatch& watch) {
  plan.dimensions == 2 ? advance_any<2>(plan, grid, band, pass, x, v, watch) : advance_any<3>(plan, grid, band, pass, x, v, watch);
}
void advance_part(const Plan& plan, Index first, Index end, const GridPass& pass, double* x, double* v, GridWatch& watch) {
  plan.dimensions == 2 ? advance_any_each<2>(plan, first, end, pass, x, v, watch)
                       : advance_any_each<3>(plan, first, end, pass, x, v, watch);
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "sim/forces/bands.h"

namespace hooke {

HWY_EXPORT(add_band);
HWY_EXPORT(accelerate_band);
HWY_EXPORT(advance_band);
HWY_EXPORT(advance_part);

namespace {

GridView<double> view_of(const Plan& plan, const Grid& grid) {
  GridView<double> view{.points = plan.points, .first = grid.first, .rows = grid.rows, .columns = grid.columns, .pitch = grid.pitch()};
  view.has_limits = !grid.max_length_squared[0].number.empty();
  const auto set = [](const auto& values, auto& numbers) {
    for (std::size_t direction = 0; direction < Grid::directions; ++direction)
      numbers[direction] = {values[direction].number.data(), values[direction].row_step};
  };
  set(grid.stiffness, view.stiffness);
  set(grid.rest_length, view.rest_length);
  set(grid.damping, view.damping);
  set(grid.max_length_squared, view.limit);
  return view;
}

// What each thread saw in each pass; unspecified until it is set.
struct Seen {
  double max_speed_squared;
  bool any_at_limit;
  void set(const GridWatch& watch) { *this = {watch.max_speed_squared, watch.any_at_limit}; }
  void add_to(GridWatch& watch) const {
    watch.max_speed_squared = std::max(watch.max_speed_squared, max_speed_squared);
    watch.any_at_limit = watch.any_at_limit || any_at_limit;
  }
};

}  // namespace

void add_grid_forces(const Plan& plan, const Grid& grid, const double* x, const double* v, double* f) {
  const GridView<double> view = view_of(plan, grid);
  for_bands(plan, view, 1, false, x, v, [&](int, int, const GridBand<double>& band) {
    HWY_DYNAMIC_DISPATCH(add_band)(plan, view, band, x, v, f);
  });
}

void accelerate_grid(const Plan& plan, const Grid& grid, const double* x, const double* v, const double* f, double* a) {
  const GridView<double> view = view_of(plan, grid);
  for_bands(plan, view, 1, false, x, v, [&](int, int, const GridBand<double>& band) {
    HWY_DYNAMIC_DISPATCH(accelerate_band)(plan, view, band, x, v, f, a);
  });
}

void advance_grid(const Plan& plan, const Grid& grid, const GridPass& pass, double* x, double* v, std::span<GridWatch> watches,
                  const RowRange& rows) {
  const GridView<double> view = view_of(plan, grid);
  const double* const dashpot_velocity = pass.dashpot_velocity != nullptr ? pass.dashpot_velocity : v;
  const bool in_place = pass.drift != 0.0 || (pass.damped && (dashpot_velocity == v || dashpot_velocity == pass.predicted));
  std::array<std::array<Seen, max_parts>, max_grid_passes> seen;
  const int passes = static_cast<int>(watches.size());
  const int parts = for_bands(plan, view, GridBand<double>{rows.begin, rows.end < 0 ? grid.rows : rows.end}, passes, in_place, x,
                              pass.damped ? dashpot_velocity : nullptr, [&](int part, int at, const GridBand<double>& band) {
                                GridWatch watch;
                                HWY_DYNAMIC_DISPATCH(advance_band)(plan, view, band, pass, x, v, watch);
                                seen[at][part].set(watch);
                              });
  for (int at = 0; at < passes; ++at)
    for (int part = 0; part < parts; ++part) seen[at][part].add_to(watches[at]);
}

void advance_points(const Plan& plan, Index first, Index end, const GridPass& pass, double* x, double* v, GridWatch& watch) {
  constexpr Index min_points = 4000;  // some microseconds
  std::array<Seen, max_parts> seen;
  const int parts = for_parts(plan, end - first, min_points, [&](int part, Index begin_of_part, Index end_of_part) {
    GridWatch watch_of_part;
    HWY_DYNAMIC_DISPATCH(advance_part)(plan, first + begin_of_part, first + end_of_part, pass, x, v, watch_of_part);
    seen[part].set(watch_of_part);
  });
  for (int part = 0; part < parts; ++part) seen[part].add_to(watch);
}

}  // namespace hooke
#endif
