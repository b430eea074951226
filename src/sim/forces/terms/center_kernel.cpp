// Compiled once for each vector unit by Highway, which picks one at run time; the same IEEE operations as point by point.
#include "sim/forces/terms/center_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/forces/terms/center_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// x^n by repeated squaring, as portable::pow
template <class D, class V = hn::Vec<D>>
HWY_INLINE V power_of(D d, V x, int n) {
  V power = hn::Set(d, 1.0);
  for (int left = n < 0 ? -n : n; left > 0; left >>= 1) {
    if (left & 1) power = hn::Mul(power, x);
    x = hn::Mul(x, x);
  }
  return n < 0 ? hn::Div(hn::Set(d, 1.0), power) : power;
}

void add_to_all(const Plan& plan, const CenterLaw& law, const double* x, double* f) {
  const std::size_t n = static_cast<std::size_t>(plan.points);
  const auto add_at = [&](auto d, std::size_t i) HWY_ATTR {
    using V = hn::Vec<decltype(d)>;
    V offset[3];
    for (int c = 0; c < plan.dimensions; ++c) offset[c] = hn::Sub(hn::LoadU(d, x + c * n + i), hn::Set(d, law.center[c]));
    if (plan.dimensions == 2) offset[2] = hn::Zero(d);
    const V square = hn::Add(hn::Add(hn::Mul(offset[0], offset[0]), hn::Mul(offset[1], offset[1])), hn::Mul(offset[2], offset[2]));
    const V r = hn::Sqrt(square), core = hn::Set(d, law.core), u = hn::Div(r, core);
    const V inside = hn::Mul(hn::Set(d, law.core_law), hn::Add(hn::Set(d, law.alpha), hn::Mul(hn::Mul(hn::Set(d, law.beta), u), u)));
    const V over_distance = hn::IfThenElse(hn::Ge(r, core), power_of(d, r, law.exponent), inside);
    const V stiffness = hn::Mul(hn::Mul(hn::LoadU(d, plan.mass.data() + i), hn::Set(d, law.strength)), over_distance);
    for (int c = 0; c < plan.dimensions; ++c)
      hn::StoreU(hn::Sub(hn::LoadU(d, f + c * n + i), hn::Mul(stiffness, offset[c])), d, f + c * n + i);
  };
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> single;
  const std::size_t lanes = hn::Lanes(wide);
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes) add_at(wide, i);
  for (; i < n; ++i) add_at(single, i);
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(add_to_all);

void add_center_forces(const Plan& plan, const CenterLaw& law, const double* x, double* f) {
  HWY_DYNAMIC_DISPATCH(add_to_all)(plan, law, x, f);
}

}  // namespace hooke
#endif
