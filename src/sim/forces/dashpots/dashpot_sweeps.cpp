// As dashpot.cpp:  a = x1 - x2,  g = decay / |a|^2,  p = g a . (v1 - v2),  v1 -= p a / m1,  v2 += p a / m2.
// a and g of all springs are computed first, and once for a backward sweep and the forward one after it. Then a spring waits only for the
// velocities of its ends. Compiled once for each vector unit by Highway; the same IEEE operations in each.
#include "sim/forces/dashpots/dashpot_sweeps.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/forces/dashpots/dashpot_sweeps.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Four = hn::CappedTag<double, 4>;

// A point or spring in one vector of four, or in numbers.
#if HWY_TARGET != HWY_SCALAR && HWY_MAX_BYTES >= 32
#define HOOKE_HAS_VECTORS_OF_FOUR 1
#else
#define HOOKE_HAS_VECTORS_OF_FOUR 0
#endif

#if HOOKE_HAS_VECTORS_OF_FOUR
struct Vector {
  hn::Vec<Four> all;
  HWY_INLINE static Vector load(const double* from) { return {hn::LoadU(Four(), from)}; }
  HWY_INLINE void store(double* to) const { hn::StoreU(all, Four(), to); }
  HWY_INLINE Vector minus(const Vector& other) const { return {hn::Sub(all, other.all)}; }
  // this + s other
  HWY_INLINE Vector plus(double s, const Vector& other) const { return {hn::Add(all, hn::Mul(hn::Set(Four(), s), other.all))}; }
  HWY_INLINE Vector minus(double s, const Vector& other) const { return {hn::Sub(all, hn::Mul(hn::Set(Four(), s), other.all))}; }
  template <int Dimensions>
  HWY_INLINE double dot(const Vector& other) const {
    const hn::Half<Four> half;
    const auto products = hn::Mul(all, other.all);
    const auto lower = hn::LowerHalf(half, products);
    const auto sum = hn::Add(lower, hn::Reverse2(half, lower));
    if constexpr (Dimensions == 2) return hn::GetLane(sum);
    return hn::GetLane(hn::Add(sum, hn::UpperHalf(half, products)));
  }
};
#else
struct Vector {
  double at[3];
  HWY_INLINE static Vector load(const double* from) { return {{from[0], from[1], from[2]}}; }
  HWY_INLINE void store(double* to) const { std::copy(at, at + 3, to); }
  HWY_INLINE Vector minus(const Vector& other) const { return {{at[0] - other.at[0], at[1] - other.at[1], at[2] - other.at[2]}}; }
  HWY_INLINE Vector plus(double s, const Vector& other) const {
    return {{at[0] + s * other.at[0], at[1] + s * other.at[1], at[2] + s * other.at[2]}};
  }
  HWY_INLINE Vector minus(double s, const Vector& other) const {
    return {{at[0] - s * other.at[0], at[1] - s * other.at[1], at[2] - s * other.at[2]}};
  }
  template <int Dimensions>
  HWY_INLINE double dot(const Vector& other) const {
    const double sum = at[0] * other.at[0] + at[1] * other.at[1];
    return Dimensions == 2 ? sum : sum + at[2] * other.at[2];
  }
};
#endif

// The components of a field, in fours, and back.
void pack_fours(const Plan& plan, const double* field, double* fours) {
  const auto n = static_cast<std::size_t>(plan.points);
  std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  const hn::ScalableTag<double> d;
  for (; i + hn::Lanes(d) <= n; i += hn::Lanes(d))
    hn::StoreInterleaved4(hn::LoadU(d, field + i), hn::LoadU(d, field + n + i),
                          plan.dimensions == 3 ? hn::LoadU(d, field + 2 * n + i) : hn::Zero(d), hn::Zero(d), d, fours + 4 * i);
#endif
  for (; i < n; ++i) {
    for (int c = 0; c < 4; ++c) fours[4 * i + c] = c < plan.dimensions ? field[c * n + i] : 0.0;
  }
}
void unpack_fours(const Plan& plan, const double* fours, double* field) {
  const auto n = static_cast<std::size_t>(plan.points);
  std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  const hn::ScalableTag<double> d;
  for (; i + hn::Lanes(d) <= n; i += hn::Lanes(d)) {
    hn::Vec<decltype(d)> x, y, z, zero;
    hn::LoadInterleaved4(d, fours + 4 * i, x, y, z, zero);
    hn::StoreU(x, d, field + i);
    hn::StoreU(y, d, field + n + i);
    if (plan.dimensions == 3) hn::StoreU(z, d, field + 2 * n + i);
  }
#endif
  for (; i < n; ++i)
    for (int c = 0; c < plan.dimensions; ++c) field[c * n + i] = fours[4 * i + c];
}

// decay[i] / square[i], 0 where ends coincide, in place of the square.
void divide_by_squares(const double* decay, double* square, std::size_t count) {
  const auto divide = [&](auto d, std::size_t i) HWY_ATTR {
    const auto length_squared = hn::LoadU(d, square + i);
    const auto is_long = hn::Ge(length_squared, hn::Set(d, min_dashpot_length_squared));
    hn::StoreU(hn::IfThenElseZero(is_long, hn::Div(hn::LoadU(d, decay + i), length_squared)), d, square + i);
  };
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> single;
  std::size_t i = 0;
  for (; i + hn::Lanes(wide) <= count; i += hn::Lanes(wide)) divide(wide, i);
  for (; i < count; ++i) divide(single, i);
}

template <int Dimensions>
void compute_factors(const double* x, const double* decay, OrderedSpring* springs, std::size_t count) {
  constexpr std::size_t block = 64;
  double factor[block];
  for (std::size_t first = 0; first < count; first += block) {
    const std::size_t size = std::min(block, count - first);
    for (std::size_t n = 0; n < size; ++n) {
      OrderedSpring& spring = springs[first + n];
      const Vector along = Vector::load(x + spring.first).minus(Vector::load(x + spring.second));
      along.store(spring.along);
      factor[n] = along.template dot<Dimensions>(along);
    }
    divide_by_squares(decay + first, factor, size);
    for (std::size_t n = 0; n < size; ++n) springs[first + n].factor = factor[n];
  }
}

template <int Dimensions>
HWY_INLINE void decay_spring(const OrderedSpring& spring, double* v) {
  double *const first = v + spring.first, *const second = v + spring.second;
  const Vector v1 = Vector::load(first), v2 = Vector::load(second), along = Vector::load(spring.along);
  const double p = spring.factor * along.template dot<Dimensions>(v1.minus(v2));
  v1.minus(spring.inverse_mass[0] * p, along).store(first);
  v2.plus(spring.inverse_mass[1] * p, along).store(second);
}

template <int Dimensions>
void decay_ordered(const OrderedSpring* springs, std::size_t count, SweepDirection sweep, double* v) {
  if (sweep == SweepDirection::Forward)
    for (const OrderedSpring* spring = springs; spring != springs + count; ++spring) decay_spring<Dimensions>(*spring, v);
  else
    for (const OrderedSpring* spring = springs + count; spring != springs; --spring) decay_spring<Dimensions>(spring[-1], v);
}

void compute_factors_of(const Plan& plan, const double* x, const double* decay, std::vector<OrderedSpring>& springs) {
  plan.dimensions == 2 ? compute_factors<2>(x, decay, springs.data(), springs.size())
                       : compute_factors<3>(x, decay, springs.data(), springs.size());
}
void decay_in_order(const Plan& plan, const std::vector<OrderedSpring>& springs, SweepDirection sweep, double* v) {
  plan.dimensions == 2 ? decay_ordered<2>(springs.data(), springs.size(), sweep, v)
                       : decay_ordered<3>(springs.data(), springs.size(), sweep, v);
}

#undef HOOKE_HAS_VECTORS_OF_FOUR
}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "sim/forces/bands.h"

namespace hooke {

HWY_EXPORT(pack_fours);
HWY_EXPORT(unpack_fours);
HWY_EXPORT(compute_factors_of);
HWY_EXPORT(decay_in_order);

namespace {

// Long runs are swept faster in vectors, and what is kept for each spring here should fit into a cache.
bool is_worth_ordering(const Plan& plan) {
  constexpr Index max_length = 10, max_springs = 150'000;
  return plan.springs <= max_springs && plan.springs <= max_length * static_cast<Index>(plan.spring.runs.size());
}

}  // namespace

void DashpotSweeps::order_springs(const Plan& plan) {
  struct Swept {
    Index packed, level;
    EdgeEnds ends;
  };
  std::vector<Swept> springs;
  std::vector<Index> level(static_cast<std::size_t>(plan.points), 0);
  Index levels = 0;
  for (const SpringRun& run : plan.spring.runs) {
    // in a run along a row, every other spring comes first
    const Index step = run.second == run.first + 1 ? 2 : 1;
    for (Index start = 0; start < step; ++start)
      for (Index e = start; e < run.count; e += step) {
        const Index i = run.first + e, j = run.second + e, own = std::max(level[i], level[j]);
        level[i] = level[j] = own + 1;
        levels = std::max(levels, own + 1);
        springs.push_back({run.begin + e, own, {i, j}});
      }
  }
  std::ranges::stable_sort(springs, {}, &Swept::level);
  springs_.clear();
  for (const Swept& spring : springs) {
    packed_.push_back(spring.packed);
    springs_.push_back({.first = 4 * static_cast<std::uint32_t>(spring.ends[0]), .second = 4 * static_cast<std::uint32_t>(spring.ends[1])});
  }
}

// Springs of each half are side by side where few springs lead from one to the other.
void DashpotSweeps::divide_springs(const Plan& plan) {
  constexpr Index min_springs = 16'000, min_springs_per_crossing = 20;
  if (plan.springs < min_springs) return;

  // between two rows, if there is a grid
  Index middle = plan.points / 2;
  for (const Grid& grid : plan.spring.grids)
    if (grid.first < middle && middle < grid.first + grid.points())
      middle = grid.first + (middle - grid.first) / grid.columns * grid.columns;

  Index crossings = 0;
  for (const SpringRun& run : plan.spring.runs) {
    // the parts of the run: both ends before the middle, one of them, none
    const Index before = std::clamp(middle - run.second, Index{0}, run.count), until = std::clamp(middle - run.first, Index{0}, run.count);
    const auto add = [&](std::vector<SpringRun>& runs, Index begin, Index end) {
      if (begin < end) runs.push_back({run.begin + begin, run.first + begin, run.second + begin, end - begin});
    };
    add(halves_[0], 0, before);
    add(middle_, before, until);
    add(halves_[1], until, run.count);
    crossings += until - before;
  }
  if (min_springs_per_crossing * crossings > plan.springs) clear_halves();
}

void DashpotSweeps::clear_halves() {
  for (std::vector<SpringRun>* runs : {&halves_[0], &halves_[1], &middle_}) runs->clear();
}

void DashpotSweeps::prepare(const Plan& plan, double duration) {
  is_known_ = false;
  plan_dashpot_decay(plan, duration, decay_);
  const bool is_ordered = is_worth_ordering(plan);
  if (known_runs_ != plan.spring.runs || is_ordered == packed_.empty()) {
    packed_.clear();
    clear_halves();
    if (is_ordered)
      order_springs(plan);
    else
      divide_springs(plan);
    known_runs_ = plan.spring.runs;
  }
  if (!is_ordered) return;
  x_.resize(4 * static_cast<std::size_t>(plan.points));
  v_.resize(x_.size());
  ordered_decay_.clear();
  for (const Index packed : packed_) ordered_decay_.push_back(decay_[packed]);
  for (OrderedSpring& spring : springs_)
    for (int end = 0; end < 2; ++end) spring.inverse_mass[end] = plan.inverse_mass[(end == 0 ? spring.first : spring.second) / 4];
}

// Forward: from the middle to both sides.
void DashpotSweeps::sweep_halves(const Plan& plan, SweepDirection sweep, const Field& x, Field& v) const {
  using enum SweepDirection;
  if (sweep == Forward) decay_dashpots(plan, middle_, decay_, Forward, x, v);
  for_parts(plan, 2, 1, [&](int, Index begin, Index end) {
    for (Index half = begin; half < end; ++half)
      decay_dashpots(plan, halves_[half], decay_, (half == 1) == (sweep == Forward) ? Forward : Backward, x, v);
  });
  if (sweep == Backward) decay_dashpots(plan, middle_, decay_, Backward, x, v);
}

void DashpotSweeps::measure(bool is_measured, std::size_t size) {
  is_measured_ = is_measured;
  has_swept_ = false;
  if (!is_measured) return;
  for (Field* field : {&before_, &change_, &work_}) field->resize(size);
}

void DashpotSweeps::begin_step() {
  if (!is_measured_) return;
  has_swept_ = false;
  std::ranges::fill(change_, 0.0);
  std::ranges::fill(work_, 0.0);
}

void DashpotSweeps::sweep(const Plan& plan, SweepDirection sweep, bool is_same, const Field& x, Field& v) {
  if (!is_measured_) return apply(plan, sweep, is_same, x, v);
  std::ranges::copy(v, before_.begin());
  apply(plan, sweep, is_same, x, v);
  has_swept_ = true;
  for (int c = 0; c < plan.dimensions; ++c)
    for (std::size_t i = 0, at = static_cast<std::size_t>(c) * plan.points; i < static_cast<std::size_t>(plan.points); ++i, ++at) {
      const double change = v[at] - before_[at];
      change_[at] += change;
      work_[at] += plan.mass[i] * change * (before_[at] + 0.5 * change);
    }
}

void DashpotSweeps::apply(const Plan& plan, SweepDirection sweep, bool is_same, const Field& x, Field& v) {
  if (!halves_[0].empty()) return sweep_halves(plan, sweep, x, v);
  if (packed_.empty()) return decay_dashpots(plan, plan.spring.runs, decay_, sweep, x, v);
  if (!is_known_ || !is_same) {
    HWY_DYNAMIC_DISPATCH(pack_fours)(plan, x.data(), x_.data());
    HWY_DYNAMIC_DISPATCH(compute_factors_of)(plan, x_.data(), ordered_decay_.data(), springs_);
    is_known_ = true;
  }
  HWY_DYNAMIC_DISPATCH(pack_fours)(plan, v.data(), v_.data());
  HWY_DYNAMIC_DISPATCH(decay_in_order)(plan, springs_, sweep, v_.data());
  HWY_DYNAMIC_DISPATCH(unpack_fours)(plan, v_.data(), v.data());
}

}  // namespace hooke
#endif
