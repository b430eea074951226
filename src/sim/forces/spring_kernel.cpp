// f = -(k (l - l0) + d w) u on the first point, the opposite on the second; u = (x1 - x2) / l, w = (v1 - v2) . u, and no
// force at l = 0. Compiled once for each vector unit by Highway, which picks one at run time. Every spring's force is
// computed by the same IEEE operations in every width, and every point sums its springs in the order of the runs. Long runs
// are read and written as whole vectors; the springs of short ones are first gathered, some dozens at a time.
#include "sim/forces/spring_kernel.h"

#include "sim/forces/grid_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/forces/spring_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Springs of a run whose forces are computed before they are added to the points, and zeros before and after them.
constexpr Index block = 64;
constexpr Index padding = 8;  // lanes of the widest vectors

// Runs up to this length are gathered: for shorter ones the overhead of a run exceeds the cost of its springs.
constexpr Index short_run = 4;

// x1 - x2 (or v1 - v2) of the springs of a run, whose ends are contiguous.
struct Ends {
  const double* first[3];
  const double* second[3];
  template <class D>
  HWY_INLINE hn::Vec<D> difference(D d, int c, Index e) const {
    return hn::Sub(hn::LoadU(d, first[c] + e), hn::LoadU(d, second[c] + e));
  }
};

// The same for gathered springs.
struct Gathered {
  double differences[3][block];
  template <class D>
  HWY_INLINE hn::Vec<D> difference(D d, int c, Index e) const {
    return hn::LoadU(d, differences[c] + e);
  }
};

// The forces of springs e .. e + lanes, into force[c][padding + e].
template <int Dimensions, bool Damped, class D, class Differences>
HWY_INLINE void compute_forces_of(D d, Index e, const Differences& x, const Differences& v, const double* stiffness,
                                  const double* rest_length, const double* damping, double (*force)[block + 2 * padding]) {
  using V = hn::Vec<D>;
  V along[Dimensions];
  V length_squared = hn::Zero(d);
  for (int c = 0; c < Dimensions; ++c) {
    along[c] = x.difference(d, c, e);
    length_squared = hn::Add(length_squared, hn::Mul(along[c], along[c]));
  }
  const V length = hn::Sqrt(length_squared);
  V tension = hn::Mul(hn::LoadU(d, stiffness + e), hn::Sub(length, hn::LoadU(d, rest_length + e)));
  if constexpr (Damped) {
    V approach = hn::Zero(d);
    for (int c = 0; c < Dimensions; ++c) approach = hn::Add(approach, hn::Mul(along[c], v.difference(d, c, e)));
    tension = hn::Add(tension, hn::Div(hn::Mul(hn::LoadU(d, damping + e), approach), length));
  }
  const V per_length = hn::IfThenZeroElse(hn::Eq(length, hn::Zero(d)), hn::Div(tension, length));
  for (int c = 0; c < Dimensions; ++c) hn::StoreU(hn::Mul(per_length, along[c]), d, force[c] + padding + e);
}

// sum[e] += sign * term[e] for e < count; sign is +-1, exact.
template <bool Subtract, class D>
HWY_INLINE void accumulate(D d, const double* term, Index count, double* sum) {
  const Index lanes = static_cast<Index>(hn::Lanes(d));
  Index e = 0;
  for (; e + lanes <= count; e += lanes) {
    const auto old = hn::LoadU(d, sum + e), change = hn::LoadU(d, term + e);
    hn::StoreU(Subtract ? hn::Sub(old, change) : hn::Add(old, change), d, sum + e);
  }
  for (; e < count; ++e) sum[e] = Subtract ? sum[e] - term[e] : sum[e] + term[e];
}

// sum[e] += term[e - 1] - term[e], the two ends of springs in a row: one pass, because a second one would load across pending stores of the
// first.
template <class D>
HWY_INLINE void accumulate_row(D d, const double* term, Index count, double* sum) {
  const Index lanes = static_cast<Index>(hn::Lanes(d));
  Index e = 0;
  for (; e + lanes <= count; e += lanes)
    hn::StoreU(hn::Add(hn::LoadU(d, sum + e), hn::Sub(hn::LoadU(d, term + e - 1), hn::LoadU(d, term + e))), d, sum + e);
  for (; e < count; ++e) sum[e] += term[e - 1] - term[e];
}

// The forces of `count` springs from the packed index `packed`. Whole vectors; the last one overlaps springs already computed instead of
// reading beyond the end.
template <int Dimensions, bool Damped, class Differences>
HWY_INLINE void compute_block(const Plan& plan, Index packed, Index count, const Differences& x, const Differences& v,
                              double (*force)[block + 2 * padding]) {
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> single;
  const Index lanes = static_cast<Index>(hn::Lanes(wide));
  const double* stiffness = plan.spring.stiffness.data() + packed;
  const double* rest_length = plan.spring.rest_length.data() + packed;
  const double* damping = Damped ? plan.spring.damping.data() + packed : nullptr;
  if (count >= lanes) {
    for (Index e = 0; e < count; e += lanes)
      compute_forces_of<Dimensions, Damped>(wide, e + lanes <= count ? e : count - lanes, x, v, stiffness, rest_length, damping, force);
  } else {
    for (Index e = 0; e < count; ++e) compute_forces_of<Dimensions, Damped>(single, e, x, v, stiffness, rest_length, damping, force);
  }
}

template <int Dimensions, bool Damped>
HWY_INLINE void add_run(const Plan& plan, const SpringRun& run, const double* x, const double* v, double* f,
                        double (*force)[block + 2 * padding]) {
  const hn::ScalableTag<double> wide;
  for (Index start = 0; start < run.count; start += block) {
    const Index count = run.count - start < block ? run.count - start : block;
    Ends position{}, velocity{};
    for (int c = 0; c < Dimensions; ++c) {
      const std::size_t component = static_cast<std::size_t>(c) * plan.points + start;
      position.first[c] = x + component + run.first;
      position.second[c] = x + component + run.second;
      if constexpr (Damped) {
        velocity.first[c] = v + component + run.first;
        velocity.second[c] = v + component + run.second;
      }
    }
    compute_block<Dimensions, Damped>(plan, run.begin + start, count, position, velocity, force);

    for (int c = 0; c < Dimensions; ++c) {
      const double* term = force[c] + padding;
      double* f_first = f + static_cast<std::size_t>(c) * plan.points + start + run.first;
      if (run.second == run.first + 1) {
        force[c][padding + count] = 0.0;
        accumulate_row(wide, term, count + 1, f_first);
      } else {
        accumulate<true>(wide, term, count, f_first);
        accumulate<false>(wide, term, count, f_first + (run.second - run.first));
      }
    }
  }
}

// Short, and its springs share no point, so that the sums do not depend on the order of springs and ends.
HWY_INLINE bool is_gathered(const SpringRun& run) { return run.count <= short_run && run.count <= run.second - run.first; }

template <int Dimensions>
HWY_INLINE void gather(const double* field, Index points, const Index* first, const Index* second, Index count, Gathered& gathered) {
  for (Index e = 0; e < count; ++e)
    for (int c = 0; c < Dimensions; ++c) {
      const double* component = field + static_cast<std::size_t>(c) * points;
      gathered.differences[c][e] = component[first[e]] - component[second[e]];
    }
}

// Gathers as many short runs that follow each other in the packed order, starting with `run`, as fit into a block; returns the first one
// left.
template <int Dimensions, bool Damped>
HWY_INLINE const SpringRun* add_short_runs(const Plan& plan, const SpringRun* run, const SpringRun* end, const double* x, const double* v,
                                           double* f, double (*force)[block + 2 * padding]) {
  // the ends are written past the end of a run and overwritten by the next one: a loop of the exact length would be mispredicted
  Index first[block], second[block];
  const Index packed = run->begin;
  Index count = 0;
  for (; run != end && is_gathered(*run) && count <= block - short_run && run->begin == packed + count; ++run) {
    const Index i = run->first, j = run->second, springs = run->count;
    for (Index e = 0; e < short_run; ++e) first[count + e] = i + e;
    for (Index e = 0; e < short_run; ++e) second[count + e] = j + e;
    count += springs;
  }

  Gathered position, velocity;
  gather<Dimensions>(x, plan.points, first, second, count, position);
  if constexpr (Damped) gather<Dimensions>(v, plan.points, first, second, count, velocity);
  compute_block<Dimensions, Damped>(plan, packed, count, position, velocity, force);

  // a spring in a row adds 0 - t to its first end, as in accumulate_row; any other spring adds -t, which is -0 - t: they differ in the sign
  // of zero
  for (Index e = 0; e < count; ++e) {
    const double zero = second[e] == first[e] + 1 ? 0.0 : -0.0;
    for (int c = 0; c < Dimensions; ++c) {
      double* sum = f + static_cast<std::size_t>(c) * plan.points;
      const double term = force[c][padding + e];
      sum[first[e]] += zero - term;
      sum[second[e]] += term;
    }
  }
  return run;
}

template <int Dimensions, bool Damped>
void add_forces(const Plan& plan, const double* x, const double* v, double* f) {
  HWY_ALIGN double force[3][block + 2 * padding] = {};
  const SpringRun* const end = plan.spring.loose_runs.data() + plan.spring.loose_runs.size();
  for (const SpringRun* run = plan.spring.loose_runs.data(); run != end;) {
    if (is_gathered(*run))
      run = add_short_runs<Dimensions, Damped>(plan, run, end, x, v, f, force);
    else
      add_run<Dimensions, Damped>(plan, *run++, x, v, f, force);
  }
}

void add_all_forces(const Plan& plan, const double* x, const double* v, double* f) {
  if (plan.dimensions == 2)
    v != nullptr ? add_forces<2, true>(plan, x, v, f) : add_forces<2, false>(plan, x, v, f);
  else
    v != nullptr ? add_forces<3, true>(plan, x, v, f) : add_forces<3, false>(plan, x, v, f);
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(add_all_forces);

void add_loose_spring_forces(const Plan& plan, const double* x, const double* v, double* f) {
  if (!plan.spring.loose_runs.empty()) HWY_DYNAMIC_DISPATCH(add_all_forces)(plan, x, v, f);
}

void add_spring_forces(const Plan& plan, const double* x, const double* v, double* f) {
  add_loose_spring_forces(plan, x, v, f);
  for (const Grid& grid : plan.spring.grids) add_grid_forces(plan, grid, x, v, f);
}

}  // namespace hooke
#endif
