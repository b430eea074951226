// p = k (1 - l0 / l) + d (w . u) / l^2,  f = -p u on the first end of a spring, +p u on the second; u = x1 - x2, w = v1 - v2, l = |u|,
// and p = 0 at l = 0.
//
//   x00 --R-- x01     A vector of cells (r, j), (r, j+1), .. loads the corners of its cells once and computes the four springs
//    | \     /        that a cell owns. The sum for its own corner x00 takes what the cell to its left has for it, moved up by
//    D   G  A         one lane, and what the row above has, from a buffer of one row. The force on row r is then complete, and
//    | /     \        no other spring needs its old position: the point can be advanced in place.
//   x10       x11
//
// Square roots and divisions take long: the p of a row are computed a row ahead, in the same loop as the sums of the row before, which
// the processor does meanwhile.
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

#include "sim/forces/columns-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Scratch of a grid: the p of one row of springs in each direction, and the force on one row of points in each component.
struct Scratch {
  double* p[Grid::directions];
  double* force[3];
  Scratch(double* buffer, const Grid& grid) {
    for (double*& row : p) row = std::exchange(buffer, buffer + grid.pitch());
    for (double*& row : force) row = std::exchange(buffer, buffer + grid.pitch());
  }
};
constexpr std::size_t scratch_rows = Grid::directions + 3;

// The points of a row and of the row below, by component.
template <int Dimensions>
struct Points {
  const double *row[Dimensions], *below[Dimensions];
  Points(const double* field, const Plan& plan, const Grid& grid, Index r) {
    for (int c = 0; c < Dimensions && field != nullptr; ++c) {
      row[c] = field + static_cast<std::size_t>(c) * plan.points + grid.first + r * grid.columns;
      below[c] = row[c] + grid.columns;
    }
  }
};

// The numbers of a row of springs.
struct Numbers {
  const double *stiffness[Grid::directions], *rest_length[Grid::directions], *damping[Grid::directions], *limit[Grid::directions];
  bool has_limits;
  Numbers(const Grid& grid, Index r, bool damped) : has_limits(!grid.max_length_squared[0].number.empty()) {
    for (std::size_t direction = 0; direction < (r + 1 < grid.rows ? Grid::directions : 1); ++direction) {
      stiffness[direction] = grid.stiffness[direction].row(r);
      rest_length[direction] = grid.rest_length[direction].row(r);
      if (damped) damping[direction] = grid.damping[direction].row(r);
      if (has_limits) limit[direction] = grid.max_length_squared[direction].row(r);
    }
  }
};

// The corners of cells, of positions or velocities.
template <int Dimensions, class V>
struct Corners {
  V x00[Dimensions], x01[Dimensions], x10[Dimensions], x11[Dimensions];
};

template <int Dimensions, bool HasBelow, class Columns, class V = typename Columns::V>
HWY_INLINE Corners<Dimensions, V> load_corners(const Columns& columns, const Points<Dimensions>& points, Index j) {
  Corners<Dimensions, V> corners;
  for (int c = 0; c < Dimensions; ++c) {
    corners.x00[c] = columns.load(points.row[c] + j);
    corners.x01[c] = columns.load_next(points.row[c] + j);
    if constexpr (!HasBelow) continue;
    corners.x10[c] = columns.load(points.below[c] + j);
    corners.x11[c] = columns.load_next(points.below[c] + j);
  }
  return corners;
}

// The p of the springs of one direction from column j on. `at_limit` collects whether springs are at least as long as their limit.
template <int Dimensions, bool Damped, class D, class V>
HWY_INLINE void compute_tension(D d, const Numbers& numbers, Grid::Direction direction, Index j, const V* x1, const V* x2, const V* v1,
                                const V* v2, double* p, hn::Mask<D>& at_limit) {
  V u[Dimensions];
  for (int c = 0; c < Dimensions; ++c) u[c] = hn::Sub(x1[c], x2[c]);
  V square = hn::Mul(u[0], u[0]);
  for (int c = 1; c < Dimensions; ++c) square = hn::Add(square, hn::Mul(u[c], u[c]));

  const V k = hn::LoadU(d, numbers.stiffness[direction] + j), rest_length = hn::LoadU(d, numbers.rest_length[direction] + j);
  V tension = hn::Mul(k, hn::Sub(hn::Set(d, 1.0), hn::Div(rest_length, hn::Sqrt(square))));
  if constexpr (Damped) {
    V approach = hn::Mul(u[0], hn::Sub(v1[0], v2[0]));
    for (int c = 1; c < Dimensions; ++c) approach = hn::Add(approach, hn::Mul(u[c], hn::Sub(v1[c], v2[c])));
    tension = hn::Add(tension, hn::Div(hn::Mul(hn::LoadU(d, numbers.damping[direction] + j), approach), square));
  }
  hn::StoreU(hn::IfThenZeroElse(hn::Eq(square, hn::Zero(d)), tension), d, p + j);
  if (numbers.has_limits) at_limit = hn::Or(at_limit, hn::Ge(square, hn::LoadU(d, numbers.limit[direction] + j)));
}

// The p of the cells from column j on.
template <int Dimensions, bool Damped, bool HasBelow, class Columns>
HWY_INLINE void compute_tensions(const Columns& columns, const Points<Dimensions>& x, const Points<Dimensions>& v, const Numbers& numbers,
                                 Index j, double* const* p, hn::Mask<typename Columns::D>& at_limit) {
  const auto d = columns.d;
  const auto at = load_corners<Dimensions, HasBelow>(columns, x, j);
  auto speed = at;
  if constexpr (Damped) speed = load_corners<Dimensions, HasBelow>(columns, v, j);
  const auto compute = [&](Grid::Direction direction, const auto* x1, const auto* x2, const auto* v1, const auto* v2) HWY_ATTR {
    compute_tension<Dimensions, Damped>(d, numbers, direction, j, x1, x2, v1, v2, p[direction], at_limit);
  };
  compute(Grid::Right, at.x00, at.x01, speed.x00, speed.x01);
  if constexpr (!HasBelow) return;
  compute(Grid::Down, at.x00, at.x10, speed.x00, speed.x10);
  compute(Grid::Diagonal, at.x00, at.x11, speed.x00, speed.x11);
  compute(Grid::Anti, at.x01, at.x10, speed.x01, speed.x10);
}

// Where the force on a row comes from and goes to: by the row above, and on the row below, which it replaces or is added to.
template <int Dimensions>
struct Sums {
  const double* from_above[Dimensions];
  double* to_below[Dimensions];
};

// The force on the own corners of the cells from column j on.
template <int Dimensions, bool HasBelow, bool Replace, class Columns, class V, class Others>
HWY_INLINE void compute_forces(const Columns& columns, const Points<Dimensions>& x, const Sums<Dimensions>& sums, Index j, const V* p,
                               const Others& others, Carry<Dimensions, V>& carry, V* force) {
  const auto d = columns.d;
  const auto at = load_corners<Dimensions, HasBelow>(columns, x, j);
  for (int c = 0; c < Dimensions; ++c) {
    const V right = hn::Mul(p[Grid::Right], hn::Sub(at.x00[c], at.x01[c]));
    V own = right, to_next = right, down, diagonal, anti;
    if constexpr (HasBelow) {
      down = hn::Mul(p[Grid::Down], hn::Sub(at.x00[c], at.x10[c]));
      diagonal = hn::Mul(p[Grid::Diagonal], hn::Sub(at.x00[c], at.x11[c]));
      anti = hn::Mul(p[Grid::Anti], hn::Sub(at.x01[c], at.x10[c]));
      own = hn::Add(hn::Add(right, down), diagonal);
      to_next = hn::Sub(right, anti);
    }
    const V from_left = shift_up(d, to_next, carry.same_row[c]);
    carry.same_row[c] = to_next;
    force[c] = hn::Add(hn::Sub(from_left, own), others(c, columns.load(sums.from_above[c] + j)));
    if constexpr (HasBelow) {
      const V below_from_left = shift_up(d, diagonal, carry.below[c]);
      carry.below[c] = diagonal;
      V below = hn::Add(hn::Add(down, anti), below_from_left);
      if constexpr (!Replace) below = hn::Add(columns.load(sums.to_below[c] + j), below);
      columns.store(below, sums.to_below[c] + j);
    }
  }
}

// Row by row from the top: use(columns, first point, force on the points from there on). Forces on the row below go to `force`, one
// row of each component and zero at first, or with Replace = false are added to the field `force`. others(columns, first point, c, force
// from above) adds other forces to the latter.
template <int Dimensions, bool Damped, bool Replace, class Others, class Use>
HWY_INLINE void compute_grid(const Plan& plan, const Grid& grid, const double* x, const double* v, double* const* p, double* const* force,
                             AnySet& at_limit, const Others& others, const Use& use) {
  const auto for_row = [&](Index r, const auto& use_row) HWY_ATTR {
    use_row(Points<Dimensions>(x, plan, grid, r), Points<Dimensions>(v, plan, grid, r), Numbers(grid, r, Damped));
  };
  const auto compute_first = [&](auto has_below) HWY_ATTR {
    for_row(0, [&](const auto& position, const auto& velocity, const auto& numbers) HWY_ATTR {
      for_columns(grid.columns, [&](const auto& columns, Index j) HWY_ATTR {
        compute_tensions<Dimensions, Damped, decltype(has_below)::value>(columns, position, velocity, numbers, j, p,
                                                                         at_limit.mask(columns.d));
      });
    });
  };
  grid.rows > 1 ? compute_first(std::true_type()) : compute_first(std::false_type());

  // `rows_below`: 0, 1, or 2 for more
  const auto compute_row = [&](Index r, auto rows_below) HWY_ATTR {
    constexpr int below = decltype(rows_below)::value;
    const Index start = grid.first + r * grid.columns, ahead = below > 0 ? r + 1 : r;
    const Points<Dimensions> position(x, plan, grid, r), position_ahead(x, plan, grid, ahead), velocity_ahead(v, plan, grid, ahead);
    const Numbers numbers_ahead(grid, ahead, Damped);
    Sums<Dimensions> sums;
    for (int c = 0; c < Dimensions; ++c) {
      sums.from_above[c] = Replace ? force[c] : force[c] + start;
      sums.to_below[c] = Replace ? force[c] : force[c] + start + grid.columns;
    }
    RowState<Dimensions> state;
    for_columns(grid.columns, [&](const auto& columns, Index j) HWY_ATTR {
      using V = typename std::remove_cvref_t<decltype(columns)>::V;
      V tension[Grid::directions], on_points[Dimensions];
      for (std::size_t direction = 0; direction < (below > 0 ? Grid::directions : 1); ++direction)
        tension[direction] = hn::LoadU(columns.d, p[direction] + j);
      if constexpr (below > 0)
        compute_tensions<Dimensions, Damped, (below > 1)>(columns, position_ahead, velocity_ahead, numbers_ahead, j, p,
                                                          at_limit.mask(columns.d));
      const auto add_others = [&](int c, V from_above) HWY_ATTR { return others(columns, start + j, c, from_above); };
      compute_forces<Dimensions, (below > 0), Replace>(columns, position, sums, j, tension, add_others, state.carry(columns.d), on_points);
      use(columns, start + j, on_points);
    });
  };
  for (Index r = 0; r + 2 < grid.rows; ++r) compute_row(r, std::integral_constant<int, 2>());
  if (grid.rows > 1) compute_row(grid.rows - 2, std::integral_constant<int, 1>());
  compute_row(grid.rows - 1, std::integral_constant<int, 0>());
}

struct NoOthers {
  template <class Columns, class V>
  HWY_INLINE V operator()(const Columns&, Index, int, V from_above) const {
    return from_above;
  }
};

template <int Dimensions, bool Damped>
void add_forces(const Plan& plan, const Grid& grid, const double* x, const double* v, double* f) {
  HWY_ALIGN double buffer[scratch_rows * Grid::max_columns];
  const Scratch scratch(buffer, grid);
  double* force[Dimensions];
  for (int c = 0; c < Dimensions; ++c) force[c] = f + static_cast<std::size_t>(c) * plan.points;
  AnySet at_limit;
  compute_grid<Dimensions, Damped, false>(plan, grid, x, v, scratch.p, force, at_limit, NoOthers(),
                                          [&](const auto& columns, Index i, const auto* on_points) HWY_ATTR {
                                            for (int c = 0; c < Dimensions; ++c) columns.store(on_points[c], force[c] + i);
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
    if (pass.drift != 0.0) columns.store(hn::Add(columns.load(x + at), hn::Mul(hn::Set(d, pass.drift), after)), x + at);
    square = hn::Add(square, hn::Mul(after, after));
  }
  return columns.valid(square);
}

// All forces but those of grids, as in compute_external_forces or from the pass, and what the row above exerts.
template <class Columns, class V>
HWY_INLINE V add_others(const Plan& plan, const GridPass& pass, const Columns& columns, Index i, int c, V from_above) {
  const V others = pass.f == nullptr ? hn::Mul(hn::Set(columns.d, plan.acceleration[c]), columns.load(plan.mass.data() + i))
                                     : columns.load(pass.f + static_cast<std::size_t>(c) * plan.points + i);
  return hn::Add(others, from_above);
}

template <int Dimensions, bool Damped, bool IsSum>
void advance(const Plan& plan, const Grid& grid, const GridPass& pass, double* x, double* v, GridWatch& watch) {
  HWY_ALIGN double buffer[scratch_rows * Grid::max_columns];
  const Scratch scratch(buffer, grid);
  for (int c = 0; c < Dimensions; ++c)
    for (Index j = 0; j < grid.pitch(); ++j) scratch.force[c][j] = 0.0;
  AnySet at_limit;
  Max max_square;
  const auto others = [&](const auto& columns, Index i, int c, auto from_above) HWY_ATTR {
    if constexpr (IsSum)
      return add_others(plan, pass, columns, i, c, from_above);
    else
      return from_above;
  };
  compute_grid<Dimensions, Damped, true>(plan, grid, x, v, scratch.p, scratch.force, at_limit, others,
                                         [&](const auto& columns, Index i, const auto* force) HWY_ATTR {
                                           max_square.add(advance_columns<Dimensions, IsSum>(plan, pass, x, v, columns, i, force));
                                         });
  watch.max_speed_squared = std::max(watch.max_speed_squared, max_square.get());
  watch.any_at_limit = watch.any_at_limit || at_limit.any();
}

template <int Dimensions, bool IsSum>
void advance_each(const Plan& plan, Index first, Index end, const GridPass& pass, double* x, double* v, GridWatch& watch) {
  const WholeVector<hn::ScalableTag<double>> whole{};
  const Index lanes = static_cast<Index>(hn::Lanes(whole.d));
  const OneColumn one{{}, false};
  Max max_square;
  const auto advance_at = [&](const auto& columns, Index i) HWY_ATTR {
    using V = typename std::remove_cvref_t<decltype(columns)>::V;
    V force[Dimensions];
    for (int c = 0; c < Dimensions; ++c) {
      force[c] = hn::Zero(columns.d);
      if constexpr (IsSum) force[c] = add_others(plan, pass, columns, i, c, force[c]);
    }
    max_square.add(advance_columns<Dimensions, IsSum>(plan, pass, x, v, columns, i, force));
  };
  Index i = first;
  for (; i + lanes <= end; i += lanes) advance_at(whole, i);
  for (; i < end; ++i) advance_at(one, i);
  watch.max_speed_squared = std::max(watch.max_speed_squared, max_square.get());
}

template <int Dimensions>
void advance_any(const Plan& plan, const Grid& grid, const GridPass& pass, double* x, double* v, GridWatch& watch) {
  if (pass.a != nullptr && !pass.is_known)
    pass.damped ? advance<Dimensions, true, true>(plan, grid, pass, x, v, watch)
                : advance<Dimensions, false, true>(plan, grid, pass, x, v, watch);
  else
    pass.damped ? advance<Dimensions, true, false>(plan, grid, pass, x, v, watch)
                : advance<Dimensions, false, false>(plan, grid, pass, x, v, watch);
}

template <int Dimensions>
void advance_any_each(const Plan& plan, Index first, Index end, const GridPass& pass, double* x, double* v, GridWatch& watch) {
  pass.a != nullptr && !pass.is_known ? advance_each<Dimensions, true>(plan, first, end, pass, x, v, watch)
                                      : advance_each<Dimensions, false>(plan, first, end, pass, x, v, watch);
}

void add_forces_2d(const Plan& plan, const Grid& grid, const double* x, const double*, double* f) {
  add_forces<2, false>(plan, grid, x, nullptr, f);
}
void add_forces_3d(const Plan& plan, const Grid& grid, const double* x, const double*, double* f) {
  add_forces<3, false>(plan, grid, x, nullptr, f);
}
void add_damped_forces_2d(const Plan& plan, const Grid& grid, const double* x, const double* v, double* f) {
  add_forces<2, true>(plan, grid, x, v, f);
}
void add_damped_forces_3d(const Plan& plan, const Grid& grid, const double* x, const double* v, double* f) {
  add_forces<3, true>(plan, grid, x, v, f);
}
void advance_2d(const Plan& plan, const Grid& grid, const GridPass& pass, double* x, double* v, GridWatch& watch) {
  advance_any<2>(plan, grid, pass, x, v, watch);
}
void advance_3d(const Plan& plan, const Grid& grid, const GridPass& pass, double* x, double* v, GridWatch& watch) {
  advance_any<3>(plan, grid, pass, x, v, watch);
}
void advance_each_2d(const Plan& plan, Index first, Index end, const GridPass& pass, double* x, double* v, GridWatch& watch) {
  advance_any_each<2>(plan, first, end, pass, x, v, watch);
}
void advance_each_3d(const Plan& plan, Index first, Index end, const GridPass& pass, double* x, double* v, GridWatch& watch) {
  advance_any_each<3>(plan, first, end, pass, x, v, watch);
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(add_forces_2d);
HWY_EXPORT(add_forces_3d);
HWY_EXPORT(add_damped_forces_2d);
HWY_EXPORT(add_damped_forces_3d);
HWY_EXPORT(advance_2d);
HWY_EXPORT(advance_3d);
HWY_EXPORT(advance_each_2d);
HWY_EXPORT(advance_each_3d);

void add_grid_forces(const Plan& plan, const Grid& grid, const double* x, const double* v, double* f) {
  if (plan.dimensions == 2)
    v != nullptr ? HWY_DYNAMIC_DISPATCH(add_damped_forces_2d)(plan, grid, x, v, f)
                 : HWY_DYNAMIC_DISPATCH(add_forces_2d)(plan, grid, x, v, f);
  else
    v != nullptr ? HWY_DYNAMIC_DISPATCH(add_damped_forces_3d)(plan, grid, x, v, f)
                 : HWY_DYNAMIC_DISPATCH(add_forces_3d)(plan, grid, x, v, f);
}

void advance_grid(const Plan& plan, const Grid& grid, const GridPass& pass, double* x, double* v, GridWatch& watch) {
  plan.dimensions == 2 ? HWY_DYNAMIC_DISPATCH(advance_2d)(plan, grid, pass, x, v, watch)
                       : HWY_DYNAMIC_DISPATCH(advance_3d)(plan, grid, pass, x, v, watch);
}

void advance_points(const Plan& plan, Index first, Index end, const GridPass& pass, double* x, double* v, GridWatch& watch) {
  plan.dimensions == 2 ? HWY_DYNAMIC_DISPATCH(advance_each_2d)(plan, first, end, pass, x, v, watch)
                       : HWY_DYNAMIC_DISPATCH(advance_each_3d)(plan, first, end, pass, x, v, watch);
}

}  // namespace hooke
#endif
