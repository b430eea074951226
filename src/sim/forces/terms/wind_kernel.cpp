// Compiled once for each vector unit by Highway, which picks one at run time; the same IEEE operations as panel by panel.
#include "sim/forces/terms/wind_kernel.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/forces/terms/wind_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "sim/forces/lane_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A point of each cell: those of the first cell is `point`.
template <class D, class V = hn::Vec<D>>
HWY_INLINE LaneVector<V> load_points(D d, const Plan& plan, const double* field, Index point) {
  const std::size_t n = static_cast<std::size_t>(plan.points), i = static_cast<std::size_t>(point);
  return {hn::LoadU(d, field + i), hn::LoadU(d, field + n + i), plan.dimensions == 3 ? hn::LoadU(d, field + 2 * n + i) : hn::Zero(d)};
}

// The corners i, j, j+1, i+1 of cells.
template <class D, class V = hn::Vec<D>>
struct CellCorners {
  LaneVector<V> at[4];
  HWY_INLINE CellCorners(D d, const Plan& plan, const double* field, Index i, Index j)
      : at{load_points(d, plan, field, i), load_points(d, plan, field, j), load_points(d, plan, field, j + 1),
           load_points(d, plan, field, i + 1)} {}
};

// As force_on_corner in wind.cpp, but for the division of both coefficients by 8. v: the sum of the velocities of the corners.
template <class D, class V = hn::Vec<D>>
HWY_INLINE LaneVector<V> force_on_corners(D d, const Wind& wind, const CellCorners<D>& x, const LaneVector<V>& v) {
  const LaneVector<V> twice_area = cross(minus(x.at[2], x.at[0]), minus(x.at[3], x.at[1]));
  const V square = dot(twice_area, twice_area);
  const LaneVector<V> velocity{hn::Set(d, wind.velocity.x), hn::Set(d, wind.velocity.y), hn::Set(d, wind.velocity.z)};
  const LaneVector<V> past = minus(velocity, times(hn::Set(d, 0.25), v));
  const V flux = dot(past, twice_area), across = hn::Div(flux, square);
  const LaneVector<V> along = minus(past, times(across, twice_area));
  const V of_normal = hn::Mul(hn::Mul(hn::Set(d, wind.normal), hn::Abs(flux)), across);
  const V of_tangential = hn::Mul(hn::Set(d, wind.tangential), hn::Sqrt(hn::Mul(square, dot(along, along))));
  const LaneVector<V> force = plus(times(of_normal, twice_area), times(of_tangential, along));
  const auto is_flat = hn::Lt(square, hn::Set(d, min_square_of_area));
  if (HWY_LIKELY(hn::AllFalse(d, is_flat))) return force;
  return {hn::IfThenZeroElse(is_flat, force.x), hn::IfThenZeroElse(is_flat, force.y), hn::IfThenZeroElse(is_flat, force.z)};
}

// use(d, cell) for the cells in vectors, for some of them twice: a vector takes no longer than one cell.
template <class Use>
HWY_INLINE void for_cells(Index cells, const Use& use) {
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> single;
  const Index lanes = static_cast<Index>(hn::Lanes(wide));
  if (cells < lanes) {
    for (Index cell = 0; cell < cells; ++cell) use(single, cell);
    return;
  }
  for (Index cell = 0;; cell = std::min(cell + lanes, cells - lanes)) {
    use(wide, cell);
    if (cell == cells - lanes) return;
  }
}

// The forces on each corner of the cells of a row, and their power at each cell.
struct RowOfCells {
  static constexpr Index before = 8, stride = before + max_cells_at_once + before;
  HWY_ALIGN double force[3][stride];
  HWY_ALIGN double power[max_cells_at_once];
};

// The power of the held point is left out below.
template <bool has_force, bool has_power>
void compute_row(const Plan& plan, const Wind wind, Index i, Index j, Index cells, const double* x, const double* v, RowOfCells& row) {
  for_cells(cells, [&](auto d, Index cell) HWY_ATTR {
    const CellCorners<decltype(d)> x_of(d, plan, x, i + cell, j + cell), v_of(d, plan, v, i + cell, j + cell);
    const auto sum = plus(plus(plus(v_of.at[0], v_of.at[1]), v_of.at[2]), v_of.at[3]);
    const auto force = force_on_corners(d, wind, x_of, sum);
    if constexpr (has_force) {
      const Index at = RowOfCells::before + cell;
      hn::StoreU(force.x, d, row.force[0] + at);
      hn::StoreU(force.y, d, row.force[1] + at);
      hn::StoreU(force.z, d, row.force[2] + at);
    }
    if constexpr (has_power) hn::StoreU(dot(force, sum), d, row.power + cell);
  });
}

// Each point takes, in the order of the cells, that of the one before it and that of its own.
void add_forces_of_row(const Plan& plan, Index i, Index j, Index cells, RowOfCells& row, double* f) {
  constexpr Index before = RowOfCells::before;
  for (int c = 0; c < plan.dimensions; ++c) {
    row.force[c][before - 1] = row.force[c][before + cells] = 0.0;
    const auto add_at = [&](auto d, Index cell) HWY_ATTR {
      const auto of_before = hn::LoadU(d, row.force[c] + before + cell - 1), own = hn::LoadU(d, row.force[c] + before + cell);
      for (const Index row_start : {i, j}) {
        double* at = f + static_cast<std::size_t>(c) * plan.points + row_start + cell;
        hn::StoreU(hn::Add(hn::Add(hn::LoadU(d, at), of_before), own), d, at);
      }
    };
    const hn::ScalableTag<double> wide;
    const hn::CappedTag<double, 1> single;
    const Index lanes = static_cast<Index>(hn::Lanes(wide)), points = cells + 1;
    Index cell = 0;
    for (; cell + lanes <= points; cell += lanes) add_at(wide, cell);
    for (; cell < points; ++cell) add_at(single, cell);
  }
}

void compute_on_cells(const Plan& plan, const Wind& air, Index i, Index j, Index cells, const double* x, const double* v, double* f,
                      double* power) {
  RowOfCells row;
  const Wind wind{air.velocity, air.normal / 8.0, air.tangential / 8.0};
  if (power == nullptr)
    compute_row<true, false>(plan, wind, i, j, cells, x, v, row);
  else
    f != nullptr ? compute_row<true, true>(plan, wind, i, j, cells, x, v, row)
                 : compute_row<false, true>(plan, wind, i, j, cells, x, v, row);
  if (f != nullptr) add_forces_of_row(plan, i, j, cells, row, f);
  if (power != nullptr)
    for (Index cell = 0; cell < cells; ++cell) power[cell] += row.power[cell];
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "sim/forces/constants.h"

namespace hooke {

HWY_EXPORT(compute_on_cells);

namespace {

// From the panel `first` on; 0: another panel, or too few cells.
Index count_cells(const std::vector<Panel<Index>>& panels, Index first) {
  const auto end = static_cast<Index>(panels.size());
  if (first + min_face_cells > end) return 0;
  const Panel<Index>& panel = panels[first];
  const auto [i, j, next_j, next_i] = panel;
  // the points of both rows are different ones
  const Index max = std::min({max_cells_at_once, end - first, std::max(i, j) - std::min(i, j) - 1});
  if (next_i != i + 1 || next_j != j + 1 || max < min_face_cells) return 0;
  const auto follows = [&](Index cell) {
    return std::ranges::equal(panels[first + cell], panel, {}, {}, [cell](Index point) { return point + cell; });
  };
  Index cells = 1;
  while (cells < max && follows(cells)) ++cells;
  return cells < min_face_cells ? 0 : cells;
}

}  // namespace

std::vector<PanelRow> find_panel_rows(const std::vector<Panel<Index>>& panels) {
  std::vector<PanelRow> rows;
  for (Index first = 0; first < static_cast<Index>(panels.size());) {
    const Index cells = count_cells(panels, first);
    if (cells > 0) rows.push_back({first, cells});
    first += std::max(cells, Index{1});
  }
  return rows;
}

void compute_wind_on_cells(const Plan& plan, const Wind& wind, const PanelRow& row, const double* x, const double* v, double* f,
                           CellPowers* power) {
  const Panel<Index>& panel = plan.force_data.panels[row.first];
  HWY_DYNAMIC_DISPATCH(compute_on_cells)
  (plan, wind, panel[0], panel[1], row.cells, x, v, f, power != nullptr ? power->of_cell.data() : nullptr);
}

}  // namespace hooke
#endif
