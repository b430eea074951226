// The springs of a SweepRun in vectors, for kernels that Highway compiles once for each vector unit. Included once for each of them.
#if defined(HOOKE_SIM_FORCES_SWEEP_SPRINGS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HOOKE_SIM_FORCES_SWEEP_SPRINGS_INL_H
#undef HOOKE_SIM_FORCES_SWEEP_SPRINGS_INL_H
#else
#define HOOKE_SIM_FORCES_SWEEP_SPRINGS_INL_H
#endif

#include <hwy/highway.h>

#include "sim/forces/sweep_runs.h"
#include "sim/plan/plan.h"

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Springs whose first ends are consecutive, one per lane. `point` is the first of them, counted from that of the run, and `place` that of
// their numbers in lists.
template <class Tag>
struct ConsecutiveSprings {
  using D = Tag;
  using V = hn::Vec<D>;
  D d;
  std::size_t point, stride, place;

  HWY_INLINE V load(const double* list) const { return hn::LoadU(d, list + place); }
  HWY_INLINE void load_ends(const double* from, V& first, V& second) const {
    first = hn::LoadU(d, from + point);
    second = hn::LoadU(d, from + point + stride);
  }
  HWY_INLINE void store_ends(V first, V second, double* to) const {
    hn::StoreU(first, d, to + point);
    hn::StoreU(second, d, to + point + stride);
  }
};

#if HWY_TARGET != HWY_SCALAR
// Fewer of them than the vector has lanes: nothing beyond them is read or written, except in lists.
template <class Tag>
struct LastSprings : ConsecutiveSprings<Tag> {
  using typename ConsecutiveSprings<Tag>::V;
  hn::Mask<Tag> here;
  HWY_INLINE LastSprings(Tag tag, std::size_t at, std::size_t stride_of_run, std::size_t place_of_first, Index count)
      : ConsecutiveSprings<Tag>{tag, at, stride_of_run, place_of_first}, here(hn::FirstN(tag, static_cast<std::size_t>(count))) {}
  HWY_INLINE void load_ends(const double* from, V& first, V& second) const {
    first = hn::MaskedLoad(here, this->d, from + this->point);
    second = hn::MaskedLoad(here, this->d, from + this->point + this->stride);
  }
  HWY_INLINE void store_ends(V first, V second, double* to) const {
    hn::BlendedStore(first, here, this->d, to + this->point);
    hn::BlendedStore(second, here, this->d, to + this->point + this->stride);
  }
};

// Every other spring of a row, one per lane, in the order in which InterleaveLower and InterleaveUpper separate the even elements of two
// vectors from the odd ones and restore them.
template <class Tag>
struct AlternateSprings {
  using D = Tag;
  using V = hn::Vec<D>;
  D d;
  std::size_t point, place;

  HWY_INLINE V load(const double* list) const {
    return hn::InterleaveLower(d, hn::LoadU(d, list + place), hn::LoadU(d, list + place + hn::Lanes(d)));
  }
  HWY_INLINE void load_ends(const double* from, V& first, V& second) const {
    const V low = hn::LoadU(d, from + point), high = hn::LoadU(d, from + point + hn::Lanes(d));
    first = hn::InterleaveLower(d, low, high);
    second = hn::InterleaveUpper(d, low, high);
  }
  HWY_INLINE void store_ends(V first, V second, double* to) const {
    hn::StoreU(hn::InterleaveLower(d, first, second), d, to + point);
    hn::StoreU(hn::InterleaveUpper(d, first, second), d, to + point + hn::Lanes(d));
  }
};

template <class Tag>
struct LastAlternateSprings : AlternateSprings<Tag> {
  using typename AlternateSprings<Tag>::V;
  hn::Mask<Tag> low, high;
  HWY_INLINE LastAlternateSprings(Tag tag, std::size_t at, std::size_t place_of_first, Index count)
      : AlternateSprings<Tag>{tag, at, place_of_first} {
    const std::size_t ends = 2 * static_cast<std::size_t>(count), lanes = hn::Lanes(tag);
    low = hn::FirstN(tag, ends < lanes ? ends : lanes);
    high = hn::FirstN(tag, ends < lanes ? 0 : ends - lanes);
  }
  HWY_INLINE void load_ends(const double* from, V& first, V& second) const {
    const V lower = hn::MaskedLoad(low, this->d, from + this->point);
    const V upper = hn::MaskedLoad(high, this->d, from + this->point + hn::Lanes(this->d));
    first = hn::InterleaveLower(this->d, lower, upper);
    second = hn::InterleaveUpper(this->d, lower, upper);
  }
  HWY_INLINE void store_ends(V first, V second, double* to) const {
    hn::BlendedStore(hn::InterleaveLower(this->d, first, second), low, this->d, to + this->point);
    hn::BlendedStore(hn::InterleaveUpper(this->d, first, second), high, this->d, to + this->point + hn::Lanes(this->d));
  }
};
#endif

// One by one.
template <class Use>
HWY_INLINE void for_single_springs(const SweepRun& run, Index n, const Use& use) {
  const hn::CappedTag<double, 1> d;
  for (; n < run.count; ++n)
    use(ConsecutiveSprings<decltype(d)>{d, static_cast<std::size_t>(n * run.step), static_cast<std::size_t>(run.second - run.first),
                                        run.place(n)});
}

// use(springs) for all springs of a run in vectors.
template <class Use>
HWY_INLINE void for_springs(const SweepRun& run, const Use& use) {
#if HWY_TARGET == HWY_SCALAR
  for_single_springs(run, 0, use);
#else
  if (run.count == 1) return for_single_springs(run, 0, use);
  const hn::ScalableTag<double> d;
  constexpr Index lanes = hn::MaxLanes(d);
  const Index rest = run.count % lanes, whole = run.count - rest;
  const auto stride = static_cast<std::size_t>(run.second - run.first),
             last = static_cast<std::size_t>(whole) * static_cast<std::size_t>(run.step);
  for (Index n = 0; n < whole; n += lanes) {
    if (run.step == 2)
      use(AlternateSprings<decltype(d)>{d, static_cast<std::size_t>(2 * n), run.place(n)});
    else
      use(ConsecutiveSprings<decltype(d)>{d, static_cast<std::size_t>(n), stride, run.place(n)});
  }
  // of vectors of two, one spring is left; their masked stores would be loads and stores of both lanes
  if (lanes < 4 || rest <= 1)
    for_single_springs(run, whole, use);
  else if (run.step == 2)
    use(LastAlternateSprings<decltype(d)>(d, last, run.place(whole), rest));
  else
    use(LastSprings<decltype(d)>(d, last, stride, run.place(whole), rest));
#endif
}

template <int Dimensions, class V>
HWY_INLINE V dot(const V* a, const V* b) {
  V sum = hn::Mul(a[0], b[0]);
  for (int c = 1; c < Dimensions; ++c) sum = hn::Add(sum, hn::Mul(a[c], b[c]));
  return sum;
}

// What the springs of a run read and write, from their first ends on. A copy that vectors cannot be stored to stays in registers.
template <int Dimensions>
struct PointsOfRun {
  const double *x[Dimensions], *inverse_mass;
  double* v[Dimensions];
  HWY_INLINE PointsOfRun(const Plan& plan, const SweepRun& run, const double* positions, double* velocities)
      : inverse_mass(plan.inverse_mass.data() + run.first) {
    for (int c = 0; c < Dimensions; ++c) {
      const std::size_t at = static_cast<std::size_t>(c) * static_cast<std::size_t>(plan.points) + static_cast<std::size_t>(run.first);
      x[c] = positions + at;
      v[c] = velocities + at;
    }
  }
};

// v1' = v1 - p a / m1,  v2' = v2 + p a / m2
template <int Dimensions, class Springs, class V>
HWY_INLINE void apply_impulses(const PointsOfRun<Dimensions>& points, const Springs& springs, V p, const V* a, const V* v1, const V* v2) {
  V inverse_mass1, inverse_mass2;
  springs.load_ends(points.inverse_mass, inverse_mass1, inverse_mass2);
  const V p1 = hn::Mul(inverse_mass1, p), p2 = hn::Mul(inverse_mass2, p);
  for (int c = 0; c < Dimensions; ++c)
    springs.store_ends(hn::Sub(v1[c], hn::Mul(p1, a[c])), hn::Add(v2[c], hn::Mul(p2, a[c])), points.v[c]);
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
