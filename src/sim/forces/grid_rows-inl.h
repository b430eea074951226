// The sums of forces over a band of rows of a grid, for kernels that Highway compiles once for each vector unit; see grid_kernel.cpp.
// Included once for each of them.
#include <algorithm>
#include <type_traits>
#include <utility>

#if defined(HOOKE_SIM_FORCES_GRID_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HOOKE_SIM_FORCES_GRID_ROWS_INL_H
#undef HOOKE_SIM_FORCES_GRID_ROWS_INL_H
#else
#define HOOKE_SIM_FORCES_GRID_ROWS_INL_H
#endif

#include <hwy/highway.h>

#include "sim/forces/columns-inl.h"
#include "sim/forces/grid_rows.h"

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The forces on a row of points, by component, from one row of cells to the next.
template <class T>
struct Scratch {
  T* force[3];
  Scratch(T* buffer, Index pitch) {
    for (T*& row : force) row = std::exchange(buffer, buffer + pitch);
  }
};
constexpr std::size_t scratch_rows = 3;

// A row of points: its first component, and the distance of the next one.
template <class T>
struct PointRow {
  const T* first = nullptr;
  std::size_t step = 0;
};

// A field, with the copy of the row below a band.
template <class T>
class RowSource {
 public:
  RowSource(const GridView<T>& grid, const GridBand<T>& band, const T* field, const T* below)
      : first_(field + grid.first), below_(below), columns_(grid.columns), points_(grid.points), end_(band.end) {}
  HWY_INLINE PointRow<T> row(Index r) const {
    if (r == end_ && below_ != nullptr) return {below_, static_cast<std::size_t>(columns_)};
    return {first_ + static_cast<std::ptrdiff_t>(r) * columns_, static_cast<std::size_t>(points_)};
  }

 private:
  const T *first_, *below_;
  Index columns_, points_, end_;
};

// The points of a row and of the row below, by component.
template <int Dimensions, class T>
struct Points {
  const T *row[Dimensions], *below[Dimensions];
  HWY_INLINE Points(const PointRow<T>& upper, const PointRow<T>& lower) {
    for (int c = 0; c < Dimensions; ++c) {
      row[c] = upper.first + static_cast<std::size_t>(c) * upper.step;
      below[c] = lower.first + static_cast<std::size_t>(c) * lower.step;
    }
  }
};

// The numbers of a row of springs.
template <class T>
struct Numbers {
  const T *stiffness[Grid::directions], *rest_length[Grid::directions], *damping[Grid::directions];
  Numbers(const GridView<T>& grid, Index r, bool damped) {
    for (std::size_t direction = 0; direction < (r + 1 < grid.rows ? Grid::directions : 1); ++direction) {
      stiffness[direction] = grid.stiffness[direction].row(r);
      rest_length[direction] = grid.rest_length[direction].row(r);
      if (damped) damping[direction] = grid.damping[direction].row(r);
    }
  }
};

// The corners of cells, of positions or velocities.
template <int Dimensions, class V>
struct Corners {
  V x00[Dimensions], x01[Dimensions], x10[Dimensions], x11[Dimensions];
};

template <int Dimensions, bool HasBelow, class Columns, class T, class V = typename Columns::V>
HWY_INLINE Corners<Dimensions, V> load_corners(const Columns& columns, const Points<Dimensions, T>& points, Index j) {
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

// The p of the springs of one direction from column j on.
template <int Dimensions, bool Damped, class D, class T, class V = hn::Vec<D>>
HWY_INLINE V compute_tension(D d, const Numbers<T>& numbers, Grid::Direction direction, Index j, const V* x1, const V* x2, const V* v1,
                             const V* v2) {
  V u[Dimensions];
  for (int c = 0; c < Dimensions; ++c) u[c] = hn::Sub(x1[c], x2[c]);
  V square = hn::Mul(u[0], u[0]);
  for (int c = 1; c < Dimensions; ++c) square = hn::Add(square, hn::Mul(u[c], u[c]));

  const V k = hn::LoadU(d, numbers.stiffness[direction] + j), rest_length = hn::LoadU(d, numbers.rest_length[direction] + j);
  V tension = hn::Mul(k, hn::Sub(hn::Set(d, T{1}), hn::Div(rest_length, hn::Sqrt(square))));
  if constexpr (Damped) {
    V approach = hn::Mul(u[0], hn::Sub(v1[0], v2[0]));
    for (int c = 1; c < Dimensions; ++c) approach = hn::Add(approach, hn::Mul(u[c], hn::Sub(v1[c], v2[c])));
    tension = hn::Add(tension, hn::Div(hn::Mul(hn::LoadU(d, numbers.damping[direction] + j), approach), square));
  }
  return hn::IfThenZeroElse(hn::Eq(square, hn::Zero(d)), tension);
}

// The force on the own corners of the cells from column j on, whose corners are `at` and whose springs have the tensions p. `row` has the
// forces of the row above, and takes those on the row below.
template <int Dimensions, bool HasBelow, class Columns, class T, class V>
HWY_INLINE void compute_forces(const Columns& columns, const Corners<Dimensions, V>& at, const Scratch<T>& row, Index j, const V* p,
                               Carry<Dimensions, V>& carry, V* force) {
  const auto d = columns.d;
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
    force[c] = hn::Add(hn::Sub(from_left, own), columns.load(row.force[c] + j));
    if constexpr (HasBelow) {
      const V below_from_left = shift_up(d, diagonal, carry.below[c]);
      carry.below[c] = diagonal;
      columns.store(hn::Add(hn::Add(down, anti), below_from_left), row.force[c] + j);
    }
  }
}

// What the rows of a band are computed from.
template <int Dimensions, class T>
struct BandPass {
  const GridView<T>& grid;
  const GridBand<T>& band;
  RowSource<T> positions, velocities;
  Scratch<T> scratch;
  HWY_INLINE Points<Dimensions, T> points(const RowSource<T>& source, Index r) const { return {source.row(r), source.row(r + 1)}; }
};

// The forces on row r. A row of the band if IsOwn; of the row above, only the forces on the band count.
template <int Dimensions, bool Damped, bool HasBelow, bool IsOwn, class T, class Use>
HWY_INLINE void compute_row(const BandPass<Dimensions, T>& pass, Index r, const Use& use) {
  const Index columns_of_row = pass.grid.columns, start = pass.grid.first + r * columns_of_row;
  const Points<Dimensions, T> position = pass.points(pass.positions, r), velocity = pass.points(pass.velocities, r);
  const Numbers<T> numbers(pass.grid, r, Damped);
  RowState<Dimensions, T> state;
  for_columns<T>(columns_of_row, [&](const auto& columns, Index j) HWY_ATTR {
    using V = typename std::remove_cvref_t<decltype(columns)>::V;
    const auto at = load_corners<Dimensions, HasBelow>(columns, position, j);
    auto speed = at;
    if constexpr (Damped) speed = load_corners<Dimensions, HasBelow>(columns, velocity, j);
    V p[Grid::directions], on_points[Dimensions];
    const auto compute = [&](Grid::Direction direction, const V* x1, const V* x2, const V* v1, const V* v2) HWY_ATTR {
      p[direction] = compute_tension<Dimensions, Damped>(columns.d, numbers, direction, j, x1, x2, v1, v2);
    };
    compute(Grid::Right, at.x00, at.x01, speed.x00, speed.x01);
    if constexpr (HasBelow) {
      compute(Grid::Down, at.x00, at.x10, speed.x00, speed.x10);
      compute(Grid::Diagonal, at.x00, at.x11, speed.x00, speed.x11);
      compute(Grid::Anti, at.x01, at.x10, speed.x01, speed.x10);
    }
    compute_forces<Dimensions, HasBelow>(columns, at, pass.scratch, j, p, state.carry(columns.d), on_points);
    if constexpr (IsOwn) use(columns, start + j, on_points);
  });
}

// In a function of its own: the loop over the rows of a whole grid remains small.
template <int Dimensions, bool Damped, class T, class Use>
HWY_NOINLINE void compute_row_above(const BandPass<Dimensions, T>& pass, const Use& use) {
  compute_row<Dimensions, Damped, true, false>(pass, pass.band.begin - 1, use);
  if (pass.band.steps != nullptr) pass.band.steps->has_read_above();
}

// The rows of a band from the top: use(columns, first point, force on the points from there on). The band's first row takes the forces of
// the row above, which it computes again. v: null without dashpots.
template <int Dimensions, bool Damped, class T, class Use>
HWY_INLINE void compute_band(const GridView<T>& grid, const GridBand<T>& band, const T* x, const T* v, const Use& use) {
  HWY_ALIGN T buffer[scratch_rows * Grid::max_columns];
  const Scratch<T> scratch(buffer, grid.pitch);
  for (T* row : scratch.force)
    for (Index j = 0; j < grid.pitch; ++j) row[j] = 0;
  const BandPass<Dimensions, T> pass{grid, band, {grid, band, x, band.x_below}, {grid, band, Damped ? v : x, band.v_below}, scratch};
  if (band.begin > 0) compute_row_above<Dimensions, Damped>(pass, use);

  const Index last = grid.rows - 1;
  for (Index r = band.begin; r < std::min(band.end, last); ++r) {
    // the last row of a band reads the copy of the next one
    if (r + 1 == band.end && band.steps != nullptr) band.steps->wait_for_below();
    compute_row<Dimensions, Damped, true, true>(pass, r, use);
  }
  if (band.end > last) compute_row<Dimensions, Damped, false, true>(pass, last, use);
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
