// As grid_kernel.cpp, in vectors of twice as many numbers.
#include "sim/forces/single_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/forces/single_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "sim/forces/grid_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <int Dimensions>
void advance(const GridView<float>& grid, const GridBand<float>& band, const SinglePass& pass, float* x, float* v) {
  HWY_ALIGN float buffer[scratch_rows * Grid::max_columns];
  const Scratch<float> scratch(buffer, grid.pitch);
  for (float* row : scratch.force)
    for (Index j = 0; j < grid.pitch; ++j) row[j] = 0.0f;
  AnySet<float> at_limit;
  const auto others = [](const auto&, Index, int, auto from_above) HWY_ATTR { return from_above; };
  const auto use = [&](const auto& columns, Index i, const auto* force) HWY_ATTR {
    const auto d = columns.d;
    const auto inverse_mass = columns.load(pass.inverse_mass + i);
    const auto is_fixed = hn::Eq(inverse_mass, hn::Zero(d));
    for (int c = 0; c < Dimensions; ++c) {
      const std::size_t at = static_cast<std::size_t>(c) * grid.points + i;
      const auto a = hn::Add(hn::Set(d, pass.acceleration[c]), hn::Mul(inverse_mass, force[c]));
      const auto before = columns.load(v + at);
      const auto kicked = hn::Add(hn::Mul(hn::Set(d, pass.decay), before), hn::Mul(hn::Set(d, pass.weight), a));
      const auto after = hn::IfThenElse(is_fixed, before, kicked);
      columns.store(after, v + at);
      columns.store(hn::Add(columns.load(x + at), hn::Mul(hn::Set(d, pass.drift), after)), x + at);
    }
  };
  compute_band<Dimensions, false, true>(grid, band, x, static_cast<const float*>(nullptr), scratch, static_cast<float*>(nullptr), at_limit,
                                        others, use);
}

void advance_any(const GridView<float>& grid, const GridBand<float>& band, const SinglePass& pass, float* x, float* v) {
  pass.dimensions == 2 ? advance<2>(grid, band, pass, x, v) : advance<3>(grid, band, pass, x, v);
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(advance_any);

void advance_band(const GridView<float>& grid, const GridBand<float>& band, const SinglePass& pass, float* x, float* v) {
  HWY_DYNAMIC_DISPATCH(advance_any)(grid, band, pass, x, v);
}

}  // namespace hooke
#endif
