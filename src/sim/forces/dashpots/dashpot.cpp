// a = x1 - x2, and for one spring after another
//   p = g a . (v1 - v2),  v1 -= p a / m1,  v2 += p a / m2,   g = decay / |a|^2, 0 where the ends coincide.
// Compiled once for each vector unit by Highway, which picks one at run time. The order is that of the runs. Within a run, spring e shares
// points only with springs e - stride and e + stride (stride = second - first), and the springs are processed from the first to the last;
// as many springs as the stride share no points, so that vectors of them give the same result as one by one. In a row (stride 1), every
// other spring comes first, then those between, which share no points either. A backward sweep is the exact reverse.
#include "sim/forces/dashpots/dashpot.h"

#include "sim/model/portable_math.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/forces/dashpots/dashpot.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "sim/forces/sweep_springs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Springs that share no point.
template <int Dimensions, class Springs>
HWY_INLINE void decay_independent(const PointsOfRun<Dimensions>& points, const double* decay, const Springs& springs) {
  using V = typename Springs::V;
  const auto d = springs.d;

  V a[Dimensions], w[Dimensions], v1[Dimensions], v2[Dimensions];
  for (int c = 0; c < Dimensions; ++c) {
    V x1, x2;
    springs.load_ends(points.x[c], x1, x2);
    springs.load_ends(points.v[c], v1[c], v2[c]);
    a[c] = hn::Sub(x1, x2);
    w[c] = hn::Sub(v1[c], v2[c]);
  }
  const V length_squared = dot<Dimensions>(a, a);
  const V g =
      hn::IfThenElseZero(hn::Ge(length_squared, hn::Set(d, min_dashpot_length_squared)), hn::Div(springs.load(decay), length_squared));
  apply_impulses(points, springs, hn::Mul(g, dot<Dimensions>(a, w)), a, v1, v2);
}

template <SweepDirection sweep, int Dimensions>
void decay_all(const Plan& plan, const double* decay, const double* x, double* v) {
  const std::vector<SpringRun>& runs = plan.spring.runs;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const SpringRun& run = runs[sweep == SweepDirection::Forward ? r : runs.size() - 1 - r];
    const Index parts = count_sweep_parts(run);
    for (Index p = 0; p < parts; ++p) {
      const SweepRun part = sweep_part(run, sweep == SweepDirection::Forward ? p : parts - 1 - p);
      const PointsOfRun<Dimensions> points(plan, part, x, v);
      for_springs(part, [points, decay](const auto& springs) HWY_ATTR { decay_independent<Dimensions>(points, decay, springs); });
    }
  }
}

void decay_springs(const Plan& plan, const double* decay, SweepDirection sweep, const double* x, double* v) {
  using enum SweepDirection;
  if (plan.dimensions == 2)
    sweep == Forward ? decay_all<Forward, 2>(plan, decay, x, v) : decay_all<Backward, 2>(plan, decay, x, v);
  else
    sweep == Forward ? decay_all<Forward, 3>(plan, decay, x, v) : decay_all<Backward, 3>(plan, decay, x, v);
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace hooke {

HWY_EXPORT(decay_springs);

void decay_dashpots(const Plan& plan, const std::vector<double>& decay, SweepDirection sweep, const Field& x, Field& v) {
  HWY_DYNAMIC_DISPATCH(decay_springs)(plan, decay.data(), sweep, x.data(), v.data());
}

void plan_dashpot_decay(const Plan& plan, double duration, std::vector<double>& decay) {
  // vectors of every other spring that are not full read on
  constexpr std::size_t padding = 16;
  decay.assign(plan.spring.damping.size() + padding, 0.0);
  // consecutive springs are usually equal, and exponentials are expensive
  double previous_exponent = 0.0, decay_fraction = 0.0;
  for_each_spring(plan, [&](Index i, Index j, Index s) {
    const double inverse = plan.inverse_mass[i] + plan.inverse_mass[j];
    const double exponent = plan.spring.damping[s] * duration * inverse;
    if (exponent != previous_exponent) {
      previous_exponent = exponent;
      decay_fraction = -portable::expm1(-exponent);
    }
    if (inverse != 0.0) decay[s] = decay_fraction / inverse;
  });
}

}  // namespace hooke
#endif
