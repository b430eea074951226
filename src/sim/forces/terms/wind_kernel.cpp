// Compiled once for each vector unit by Highway, which picks one at run time; the same IEEE operations as face by face.
#include "sim/forces/terms/wind_kernel.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/forces/terms/wind_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Air {
  V x, y, z;
};
template <class V>
HWY_INLINE Air<V> minus(const Air<V>& a, const Air<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class V>
HWY_INLINE Air<V> plus(const Air<V>& a, const Air<V>& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
template <class V>
HWY_INLINE Air<V> scaled(V s, const Air<V>& a) {
  return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
template <class V>
HWY_INLINE V dot_product(const Air<V>& a, const Air<V>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
template <class V>
HWY_INLINE V difference_of_products(V a, V b, V c, V d) {
  return hn::Sub(hn::Mul(a, b), hn::Mul(c, d));
}
template <class V>
HWY_INLINE Air<V> cross_product(const Air<V>& a, const Air<V>& b) {
  return {difference_of_products(a.y, b.z, b.y, a.z), difference_of_products(a.z, b.x, b.z, a.x),
          difference_of_products(a.x, b.y, b.x, a.y)};
}

// A point of each cell: those of the first cell is `point`.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Air<V> load_points(D d, const Plan& plan, const double* field, Index point) {
  const std::size_t n = static_cast<std::size_t>(plan.points), i = static_cast<std::size_t>(point);
  return {hn::LoadU(d, field + i), hn::LoadU(d, field + n + i), plan.dimensions == 3 ? hn::LoadU(d, field + 2 * n + i) : hn::Zero(d)};
}

// As force_on_corner in wind.cpp.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Air<V> force_on_corners(D d, const Wind& wind, const Air<V>* x, const Air<V>* v) {
  const Air<V> twice_area = cross_product(minus(x[1], x[0]), minus(x[2], x[0]));
  const V square = dot_product(twice_area, twice_area);
  const Air<V> velocity{hn::Set(d, wind.velocity.x), hn::Set(d, wind.velocity.y), hn::Set(d, wind.velocity.z)};
  const Air<V> past = minus(velocity, scaled(hn::Set(d, 1.0 / 3.0), plus(plus(v[0], v[1]), v[2])));
  const V flux = dot_product(past, twice_area), across = hn::Div(flux, square);
  const Air<V> along = minus(past, scaled(across, twice_area));
  const V of_normal = hn::Mul(hn::Mul(hn::Set(d, wind.normal / 6.0), hn::Abs(flux)), across);
  const V of_tangential = hn::Mul(hn::Set(d, wind.tangential / 6.0), hn::Sqrt(hn::Mul(square, dot_product(along, along))));
  const Air<V> force = plus(scaled(of_normal, twice_area), scaled(of_tangential, along));
  const auto is_flat = hn::Lt(square, hn::Set(d, min_square_of_area));
  return {hn::IfThenZeroElse(is_flat, force.x), hn::IfThenZeroElse(is_flat, force.y), hn::IfThenZeroElse(is_flat, force.z)};
}

// The corners i, j, i+1, j+1 of the cells from `cell` on.
template <class D, class V = hn::Vec<D>>
struct CellCorners {
  Air<V> at[4];
  HWY_INLINE CellCorners(D d, const Plan& plan, const double* field, Index i, Index j)
      : at{load_points(d, plan, field, i), load_points(d, plan, field, j), load_points(d, plan, field, i + 1),
           load_points(d, plan, field, j + 1)} {}
};

// use(d, cell, corners of v, force on each corner of the first face, and of the second) for the cells, for some of them twice.
template <class Use>
HWY_INLINE void for_cells(const Plan& plan, const Wind& wind, Index i, Index j, Index cells, const double* x, const double* v,
                          const Use& use) {
  const auto compute = [&](auto d, Index cell) HWY_ATTR {
    using D = decltype(d);
    using V = hn::Vec<D>;
    const CellCorners<D> position(d, plan, x, i + cell, j + cell), velocity(d, plan, v, i + cell, j + cell);
    const Air<V> first_x[] = {position.at[0], position.at[1], position.at[2]},
                 second_x[] = {position.at[2], position.at[1], position.at[3]};
    const Air<V> first_v[] = {velocity.at[0], velocity.at[1], velocity.at[2]},
                 second_v[] = {velocity.at[2], velocity.at[1], velocity.at[3]};
    use(d, cell, velocity.at, force_on_corners(d, wind, first_x, first_v), force_on_corners(d, wind, second_x, second_v));
  };
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> single;
  const Index lanes = static_cast<Index>(hn::Lanes(wide));
  Index cell = 0;
  for (; cell + lanes <= cells; cell += lanes) compute(wide, cell);
  // the rest again with cells before them: a vector takes no longer than one cell
  if (cell < cells && cells >= lanes) return compute(wide, cells - lanes);
  for (; cell < cells; ++cell) compute(single, cell);
}

// The point c of the upper row takes, in the order of the faces, both of the cell before it and the first of its own; that of the lower row
// takes the second of the cell before it and both of its own.
void add_on_cells(const Plan& plan, const Wind& wind, Index first, Index cells, const double* x, const double* v, double* f) {
  constexpr Index before = 8;
  HWY_ALIGN double forces[2][3][before + max_cells_at_once + before];
  const Index i = plan.faces[static_cast<std::size_t>(first)][0], j = plan.faces[static_cast<std::size_t>(first)][1];
  for_cells(plan, wind, i, j, cells, x, v, [&](auto d, Index cell, const auto*, const auto& on_first, const auto& on_second) HWY_ATTR {
    const Index at = before + cell;
    hn::StoreU(on_first.x, d, forces[0][0] + at);
    hn::StoreU(on_first.y, d, forces[0][1] + at);
    hn::StoreU(on_first.z, d, forces[0][2] + at);
    hn::StoreU(on_second.x, d, forces[1][0] + at);
    hn::StoreU(on_second.y, d, forces[1][1] + at);
    hn::StoreU(on_second.z, d, forces[1][2] + at);
  });
  for (int c = 0; c < plan.dimensions; ++c) {
    for (auto& face : forces) face[c][before - 1] = face[c][before + cells] = 0.0;
    const auto add_at = [&](auto d, Index cell) HWY_ATTR {
      const auto load = [&](int face, Index at) HWY_ATTR { return hn::LoadU(d, forces[face][c] + before + at); };
      double* upper = f + static_cast<std::size_t>(c) * plan.points + i + cell;
      double* lower = f + static_cast<std::size_t>(c) * plan.points + j + cell;
      const auto first_before = load(0, cell - 1), second_before = load(1, cell - 1), first_own = load(0, cell);
      hn::StoreU(hn::Add(hn::Add(hn::Add(hn::LoadU(d, upper), first_before), second_before), first_own), d, upper);
      hn::StoreU(hn::Add(hn::Add(hn::Add(hn::LoadU(d, lower), second_before), first_own), load(1, cell)), d, lower);
    };
    const hn::ScalableTag<double> wide;
    const hn::CappedTag<double, 1> single;
    const Index lanes = static_cast<Index>(hn::Lanes(wide)), points = cells + 1;
    Index cell = 0;
    for (; cell + lanes <= points; cell += lanes) add_at(wide, cell);
    for (; cell < points; ++cell) add_at(single, cell);
  }
}

double power_on_cells(const Plan& plan, const Wind& wind, Index first, Index cells, const double* x, const double* v) {
  HWY_ALIGN double power[max_cells_at_once];
  const Index i = plan.faces[static_cast<std::size_t>(first)][0], j = plan.faces[static_cast<std::size_t>(first)][1];
  for_cells(
      plan, wind, i, j, cells, x, v, [&](auto d, Index cell, const auto* velocity, const auto& on_first, const auto& on_second) HWY_ATTR {
        using V = hn::Vec<decltype(d)>;
        const Index point[] = {i + cell, j + cell, i + cell + 1, j + cell + 1};
        const auto free = [&](int corner) HWY_ATTR {
          const auto is_fixed = hn::Eq(hn::LoadU(d, plan.inverse_mass.data() + point[corner]), hn::Zero(d));
          const auto& v_of = velocity[corner];
          return Air<V>{hn::IfThenZeroElse(is_fixed, v_of.x), hn::IfThenZeroElse(is_fixed, v_of.y), hn::IfThenZeroElse(is_fixed, v_of.z)};
        };
        const Air<V> of_both = plus(free(1), free(2));
        const V of_first = dot_product(on_first, plus(free(0), of_both)), of_second = dot_product(on_second, plus(of_both, free(3)));
        hn::StoreU(hn::Add(of_first, of_second), d, power + cell);
      });
  // cell by cell, so that the sum does not depend on the width of the vectors
  double sum = 0.0;
  for (Index cell = 0; cell < cells; ++cell) sum += power[cell];
  return sum;
}

// How many cells in a row have the first one's faces with all corners one larger in each than in the one before; up to `max`.
Index count_same_cells(const Index* corners, Index max) {
  constexpr Index corners_of_cell = 6;
  const hn::ScalableTag<Index> d;
  const Index lanes = static_cast<Index>(hn::Lanes(d)), end = corners_of_cell * (max - 1);
  const auto one = hn::Set(d, 1);
  Index at = 0;
  for (; at + lanes <= end; at += lanes)
    if (!hn::AllTrue(d, hn::Eq(hn::Sub(hn::LoadU(d, corners + at + corners_of_cell), hn::LoadU(d, corners + at)), one))) break;
  while (at < end && corners[at + corners_of_cell] == corners[at] + 1) ++at;
  return 1 + at / corners_of_cell;
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(add_on_cells);
HWY_EXPORT(power_on_cells);
HWY_EXPORT(count_same_cells);

Index count_cells(const Plan& plan, Index first) {
  constexpr Index min_cells = 4, max_cells = max_cells_at_once;
  const auto end = static_cast<Index>(plan.faces.size());
  if (first + 2 * min_cells > end) return 0;
  const std::array<Index, 3>* face = plan.faces.data() + first;
  const Index i = face[0][0], j = face[0][1];
  // the points of both rows are different ones
  const Index max = std::min({max_cells, (end - first) / 2, std::max(i, j) - std::min(i, j) - 1});
  const bool fits = face[0][2] == i + 1 && face[1][0] == i + 1 && face[1][1] == j && face[1][2] == j + 1;
  if (!fits || max < min_cells) return 0;
  const Index cells = HWY_DYNAMIC_DISPATCH(count_same_cells)(face->data(), max);
  return cells < min_cells ? 0 : cells;
}

void add_wind_on_cells(const Plan& plan, const Wind& wind, Index first, Index cells, const double* x, const double* v, double* f) {
  HWY_DYNAMIC_DISPATCH(add_on_cells)(plan, wind, first, cells, x, v, f);
}

double wind_power_on_cells(const Plan& plan, const Wind& wind, Index first, Index cells, const double* x, const double* v) {
  return HWY_DYNAMIC_DISPATCH(power_on_cells)(plan, wind, first, cells, x, v);
}

}  // namespace hooke
#endif
