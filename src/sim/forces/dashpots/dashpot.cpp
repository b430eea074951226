// a = x1 - x2, and for one spring after another
//   p = g a . (v1 - v2),  v1 -= p a / m1,  v2 += p a / m2,   g = decay / |a|^2, 0 where the ends coincide.
// Compiled once for each vector unit by Highway, which picks one at run time. The order is that of the runs. Within a run, spring e shares
// points only with springs e - stride and e + stride (stride = second - first), and the springs are processed from the first to the last;
// fewer springs than the stride share no points, so that a vector of them gives the same result as one by one. In a row (stride 1), every
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

// The operands of the springs of a run: element e belongs to the first end of spring e, e + stride to the second.
template <int Dimensions>
struct Springs {
  Index count, stride;
  const double* decay;
  const double* inverse_mass;
  const double* x[Dimensions];
  double* v[Dimensions];

  HWY_INLINE Springs(const Plan& plan, const SpringRun& run, const double* decays, const double* positions, double* velocities)
      : count(run.count), stride(run.second - run.first), decay(decays + run.begin), inverse_mass(plan.inverse_mass.data() + run.first) {
    for (int c = 0; c < Dimensions; ++c) {
      const std::size_t at = static_cast<std::size_t>(c) * plan.points + run.first;
      x[c] = positions + at;
      v[c] = velocities + at;
    }
  }
};

// Springs that share no point.
template <int Dimensions, class Access>
HWY_INLINE void decay_independent(const Springs<Dimensions>& springs, const Access& access) {
  using V = typename Access::V;
  const auto d = access.d;

  V a[Dimensions], w[Dimensions], v1[Dimensions], v2[Dimensions];
  for (int c = 0; c < Dimensions; ++c) {
    V x1, x2;
    access.load_ends(springs.x[c], x1, x2);
    access.load_ends(springs.v[c], v1[c], v2[c]);
    a[c] = hn::Sub(x1, x2);
    w[c] = hn::Sub(v1[c], v2[c]);
  }
  const V length_squared = dot<Dimensions>(a, a);
  const V g = hn::IfThenElseZero(hn::Ge(length_squared, hn::Set(d, min_dashpot_length_squared)),
                                 hn::Div(access.load(springs.decay), length_squared));
  const V p = hn::Mul(g, dot<Dimensions>(a, w));

  V inverse_mass1, inverse_mass2;
  access.load_ends(springs.inverse_mass, inverse_mass1, inverse_mass2);
  const V p1 = hn::Mul(inverse_mass1, p), p2 = hn::Mul(inverse_mass2, p);
  for (int c = 0; c < Dimensions; ++c)
    access.store_ends(hn::Sub(v1[c], hn::Mul(p1, a[c])), hn::Add(v2[c], hn::Mul(p2, a[c])), springs.v[c]);
}

// The springs first, first + 1, .. of a run in a vector.
template <int Dimensions, class D>
HWY_INLINE void decay_vector(const Springs<Dimensions>& springs, D d, Index first) {
  const auto at = static_cast<std::size_t>(first);
  decay_independent(springs, ConsecutiveSprings<D>{d, at, static_cast<std::size_t>(springs.stride), at});
}

// Vectors of up to `Lanes` springs, no more than the stride, and what is left of the run in one that is not full.
template <SweepDirection sweep, int Lanes, int Dimensions>
HWY_INLINE void decay_vectors(const Springs<Dimensions>& springs) {
  const hn::CappedTag<double, Lanes> d;
  const Index lanes = static_cast<Index>(hn::Lanes(d)), rest = springs.count % lanes;
  for (Index done = 0; done + lanes <= springs.count; done += lanes)
    decay_vector(springs, d, sweep == SweepDirection::Forward ? done : springs.count - done - lanes);
  const Index first = sweep == SweepDirection::Forward ? springs.count - rest : 0;
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(d) >= 4) {
    if (rest > 1) {
      const auto at = static_cast<std::size_t>(first);
      return decay_independent(springs, LastSprings<decltype(d)>(d, at, static_cast<std::size_t>(springs.stride), at, rest));
    }
  }
#endif
  if (rest == 1) decay_vector(springs, hn::CappedTag<double, 1>(), first);
}

template <SweepDirection sweep, int Dimensions>
HWY_INLINE void decay_run(const Springs<Dimensions>& springs) {
  if (springs.stride >= 8) return decay_vectors<sweep, 8>(springs);
  if (springs.stride >= 4) return decay_vectors<sweep, 4>(springs);
  decay_vectors<sweep, 2>(springs);
}

// Every other spring of a row starting at `first`: they share no points, so their order does not matter.
template <int Dimensions>
HWY_INLINE void decay_half_row(const Springs<Dimensions>& springs, Index first) {
#if HWY_TARGET != HWY_SCALAR
  const hn::ScalableTag<double> d;
  const Index lanes = static_cast<Index>(hn::Lanes(d));
  for (; first + 2 * lanes <= springs.count + 1; first += 2 * lanes)
    decay_independent(springs, AlternateSprings<decltype(d)>{d, static_cast<std::size_t>(first), static_cast<std::size_t>(first)});
  if constexpr (hn::MaxLanes(d) >= 4) {
    const Index rest = (springs.count + 1 - first) / 2;
    const auto at = static_cast<std::size_t>(first);
    if (rest > 1) return decay_independent(springs, LastAlternateSprings<decltype(d)>(d, at, at, rest));
  }
#endif
  for (; first < springs.count; first += 2) decay_vector(springs, hn::CappedTag<double, 1>(), first);
}

template <SweepDirection sweep, int Dimensions>
void decay_all(const Plan& plan, const double* decay, const double* x, double* v) {
  const std::vector<SpringRun>& runs = plan.spring.runs;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Springs<Dimensions> springs(plan, runs[sweep == SweepDirection::Forward ? r : runs.size() - 1 - r], decay, x, v);
    if (springs.count == 1) {
      decay_vector(springs, hn::CappedTag<double, 1>(), 0);
    } else if (springs.stride > 1) {
      decay_run<sweep>(springs);
    } else {
      decay_half_row(springs, sweep == SweepDirection::Forward ? 0 : 1);
      decay_half_row(springs, sweep == SweepDirection::Forward ? 1 : 0);
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
