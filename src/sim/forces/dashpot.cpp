// a = x1 - x2, and for one spring after another
//   p = g a . (v1 - v2),  v1 -= p a / m1,  v2 += p a / m2,   g = decay / |a|^2, 0 where the ends coincide.
// Compiled once for each vector unit by Highway, which picks one at run time. The order is that of the runs. Within a run, spring e shares
// points only with springs e - stride and e + stride (stride = second - first), and the springs are processed from the first to the last;
// fewer springs than the stride share no points, so that a vector of them gives the same result as one by one. In a row (stride 1), every
// other spring comes first, then those between, which share no points either. A backward sweep is the exact reverse.
#include "sim/forces/dashpot.h"
#include "sim/portable_math.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/forces/dashpot.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// [m^2], of coincident ends: shorter springs have no well-defined direction, and g may overflow
constexpr double min_length_squared = 1e-280;

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

template <int Dimensions, class V>
HWY_INLINE V dot(const V* a, const V* b) {
  V sum = hn::Mul(a[0], b[0]);
  for (int c = 1; c < Dimensions; ++c) sum = hn::Add(sum, hn::Mul(a[c], b[c]));
  return sum;
}

// Springs e, e + 1, ..., one per lane.
template <int Dimensions, class D>
struct ConsecutiveSprings {
  D d;
  Index e;
  const Springs<Dimensions>& springs;
  using V = hn::Vec<D>;

  HWY_INLINE V load_decay() const { return hn::LoadU(d, springs.decay + e); }
  HWY_INLINE void load_ends(const double* from, V& first, V& second) const {
    first = hn::LoadU(d, from + e);
    second = hn::LoadU(d, from + e + springs.stride);
  }
  HWY_INLINE void store_ends(V first, V second, double* to) const {
    hn::StoreU(first, d, to + e);
    hn::StoreU(second, d, to + e + springs.stride);
  }
};

#if HWY_TARGET != HWY_SCALAR
// Springs e, e + 2, ... of a row, one per lane, in the order in which InterleaveLower and InterleaveUpper separate the even elements of two
// vectors from the odd ones and restore them.
template <int Dimensions, class D>
struct AlternateSprings {
  D d;
  Index e;
  const Springs<Dimensions>& springs;
  using V = hn::Vec<D>;

  HWY_INLINE V load_decay() const {
    return hn::InterleaveLower(d, hn::LoadU(d, springs.decay + e), hn::LoadU(d, springs.decay + e + hn::Lanes(d)));
  }
  HWY_INLINE void load_ends(const double* from, V& first, V& second) const {
    const V low = hn::LoadU(d, from + e), high = hn::LoadU(d, from + e + hn::Lanes(d));
    first = hn::InterleaveLower(d, low, high);
    second = hn::InterleaveUpper(d, low, high);
  }
  HWY_INLINE void store_ends(V first, V second, double* to) const {
    hn::StoreU(hn::InterleaveLower(d, first, second), d, to + e);
    hn::StoreU(hn::InterleaveUpper(d, first, second), d, to + e + hn::Lanes(d));
  }
};
#endif

// Springs that share no point.
template <int Dimensions, template <int, class> class Access, class D>
HWY_INLINE void decay_independent(const Access<Dimensions, D>& access) {
  using V = hn::Vec<D>;
  const D d = access.d;
  const Springs<Dimensions>& springs = access.springs;

  V a[Dimensions], w[Dimensions], v1[Dimensions], v2[Dimensions];
  for (int c = 0; c < Dimensions; ++c) {
    V x1, x2;
    access.load_ends(springs.x[c], x1, x2);
    access.load_ends(springs.v[c], v1[c], v2[c]);
    a[c] = hn::Sub(x1, x2);
    w[c] = hn::Sub(v1[c], v2[c]);
  }
  const V length_squared = dot<Dimensions>(a, a);
  const V g = hn::IfThenElseZero(hn::Ge(length_squared, hn::Set(d, min_length_squared)), hn::Div(access.load_decay(), length_squared));
  const V p = hn::Mul(g, dot<Dimensions>(a, w));

  V inverse_mass1, inverse_mass2;
  access.load_ends(springs.inverse_mass, inverse_mass1, inverse_mass2);
  const V p1 = hn::Mul(inverse_mass1, p), p2 = hn::Mul(inverse_mass2, p);
  for (int c = 0; c < Dimensions; ++c)
    access.store_ends(hn::Sub(v1[c], hn::Mul(p1, a[c])), hn::Add(v2[c], hn::Mul(p2, a[c])), springs.v[c]);
}

// Whole vectors of up to `Lanes` springs after the first `done` of the sweep; returns the new number of springs done.
template <Sweep sweep, int Lanes, int Dimensions>
HWY_INLINE Index decay_consecutive(const Springs<Dimensions>& springs, Index done) {
  const hn::CappedTag<double, Lanes> d;
  const Index lanes = static_cast<Index>(hn::Lanes(d));
  for (; done + lanes <= springs.count; done += lanes)
    decay_independent(
        ConsecutiveSprings<Dimensions, decltype(d)>{d, sweep == Sweep::Forward ? done : springs.count - done - lanes, springs});
  return done;
}

template <Sweep sweep, int Dimensions>
HWY_INLINE void decay_run(const Springs<Dimensions>& springs) {
  Index done = 0;
  if (springs.stride >= 8) done = decay_consecutive<sweep, 8>(springs, done);
  if (springs.stride >= 4) done = decay_consecutive<sweep, 4>(springs, done);
  if (springs.stride >= 2) done = decay_consecutive<sweep, 2>(springs, done);
  decay_consecutive<sweep, 1>(springs, done);
}

#if HWY_TARGET != HWY_SCALAR
// Springs e, e + 2, ... in whole vectors of up to `Lanes`; returns the first one left.
template <int Lanes, int Dimensions>
HWY_INLINE Index decay_alternate(const Springs<Dimensions>& springs, Index e) {
  const hn::CappedTag<double, Lanes> d;
  const Index step = 2 * static_cast<Index>(hn::Lanes(d));
  for (; e + step <= springs.count + 1; e += step) decay_independent(AlternateSprings<Dimensions, decltype(d)>{d, e, springs});
  return e;
}
#endif

// Every other spring of a row starting at `e`: they share no points, so their order does not matter.
template <int Dimensions>
HWY_INLINE void decay_half_row(const Springs<Dimensions>& springs, Index e) {
#if HWY_TARGET != HWY_SCALAR
  e = decay_alternate<8>(springs, e);
  e = decay_alternate<4>(springs, e);
  e = decay_alternate<2>(springs, e);
#endif
  const hn::CappedTag<double, 1> single;
  for (; e < springs.count; e += 2) decay_independent(ConsecutiveSprings<Dimensions, decltype(single)>{single, e, springs});
}

template <Sweep sweep, int Dimensions>
void decay_all(const Plan& plan, const double* decay, const double* x, double* v) {
  const std::size_t runs = plan.runs.size();
  for (std::size_t r = 0; r < runs; ++r) {
    const Springs<Dimensions> springs(plan, plan.runs[sweep == Sweep::Forward ? r : runs - 1 - r], decay, x, v);
    if (springs.count == 1) {
      const hn::CappedTag<double, 1> single;
      decay_independent(ConsecutiveSprings<Dimensions, decltype(single)>{single, 0, springs});
    } else if (springs.stride > 1) {
      decay_run<sweep>(springs);
    } else {
      decay_half_row(springs, sweep == Sweep::Forward ? 0 : 1);
      decay_half_row(springs, sweep == Sweep::Forward ? 1 : 0);
    }
  }
}

void forward_2d(const Plan& plan, const double* decay, const double* x, double* v) { decay_all<Sweep::Forward, 2>(plan, decay, x, v); }
void forward_3d(const Plan& plan, const double* decay, const double* x, double* v) { decay_all<Sweep::Forward, 3>(plan, decay, x, v); }
void backward_2d(const Plan& plan, const double* decay, const double* x, double* v) { decay_all<Sweep::Backward, 2>(plan, decay, x, v); }
void backward_3d(const Plan& plan, const double* decay, const double* x, double* v) { decay_all<Sweep::Backward, 3>(plan, decay, x, v); }

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <cmath>

namespace hooke {

HWY_EXPORT(forward_2d);
HWY_EXPORT(forward_3d);
HWY_EXPORT(backward_2d);
HWY_EXPORT(backward_3d);

void decay_dashpots(const Plan& plan, const std::vector<double>& decay, Sweep sweep, const Field& x, Field& v) {
  if (plan.dimensions == 2)
    sweep == Sweep::Forward ? HWY_DYNAMIC_DISPATCH(forward_2d)(plan, decay.data(), x.data(), v.data())
                            : HWY_DYNAMIC_DISPATCH(backward_2d)(plan, decay.data(), x.data(), v.data());
  else
    sweep == Sweep::Forward ? HWY_DYNAMIC_DISPATCH(forward_3d)(plan, decay.data(), x.data(), v.data())
                            : HWY_DYNAMIC_DISPATCH(backward_3d)(plan, decay.data(), x.data(), v.data());
}

void plan_dashpot_decay(const Plan& plan, double duration, std::vector<double>& decay) {
  decay.assign(plan.damping.size() + 1, 0.0);
  // consecutive springs are usually equal, and exponentials are expensive
  double previous_exponent = 0.0, decay_fraction = 0.0;
  for (const SpringRun& run : plan.runs)
    for (Index e = 0; e < run.count; ++e) {
      const double inverse = plan.inverse_mass[run.first + e] + plan.inverse_mass[run.second + e];
      const double exponent = plan.damping[run.begin + e] * duration * inverse;
      if (exponent != previous_exponent) {
        previous_exponent = exponent;
        decay_fraction = -portable::expm1(-exponent);
      }
      if (inverse != 0.0) decay[run.begin + e] = decay_fraction / inverse;
    }
}

}  // namespace hooke
#endif
