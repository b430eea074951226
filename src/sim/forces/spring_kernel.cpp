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

#if HWY_TARGET != HWY_SCALAR && HWY_MAX_BYTES >= 32
// In a small net whose runs are short, points and sums are in fours, one vector each: a spring reads two and adds to two, instead of six
// numbers each.
constexpr Index max_points_in_fours = 512;
bool is_in_fours(const Plan& plan) {
  constexpr Index max_length = 10;
  return plan.points <= max_points_in_fours && plan.springs <= max_length * static_cast<Index>(plan.spring.runs.size());
}

using Four = hn::CappedTag<double, 4>;

template <int Dimensions>
HWY_INLINE void pack_in_fours(const double* field, Index n, double* fours) {
  const hn::ScalableTag<double> d;
  const Index lanes = static_cast<Index>(hn::Lanes(d));
  const double* z = field + (Dimensions - 1) * static_cast<std::size_t>(n);
  Index i = 0;
  for (; i + lanes <= n; i += lanes)
    hn::StoreInterleaved4(hn::LoadU(d, field + i), hn::LoadU(d, field + n + i), Dimensions == 3 ? hn::LoadU(d, z + i) : hn::Zero(d),
                          hn::Zero(d), d, fours + 4 * i);
  for (; i < n; ++i)
    for (int c = 0; c < 4; ++c) fours[4 * i + c] = c < Dimensions ? field[c * n + i] : 0.0;
}
template <int Dimensions>
HWY_INLINE void unpack_from_fours(const double* fours, Index n, double* field) {
  const hn::ScalableTag<double> d;
  const Index lanes = static_cast<Index>(hn::Lanes(d));
  Index i = 0;
  for (; i + lanes <= n; i += lanes) {
    hn::Vec<decltype(d)> x, y, z, zero;
    hn::LoadInterleaved4(d, fours + 4 * i, x, y, z, zero);
    hn::StoreU(x, d, field + i);
    hn::StoreU(y, d, field + n + i);
    if constexpr (Dimensions == 3) hn::StoreU(z, d, field + 2 * n + i);
  }
  for (; i < n; ++i)
    for (int c = 0; c < Dimensions; ++c) field[c * n + i] = fours[4 * i + c];
}

// The springs of some runs.
struct BlockInFours {
  HWY_ALIGN double along[4 * block], force[4 * block];
  double stiffness[block], rest_length[block];
};

// As compute_forces_of, in fours.
template <int Dimensions, class D>
HWY_INLINE void compute_fours_of(D d, Index e, BlockInFours& springs) {
  using V = hn::Vec<D>;
  V along[4];
  hn::LoadInterleaved4(d, springs.along + 4 * e, along[0], along[1], along[2], along[3]);
  V length_squared = hn::Zero(d);
  for (int c = 0; c < Dimensions; ++c) length_squared = hn::Add(length_squared, hn::Mul(along[c], along[c]));
  const V length = hn::Sqrt(length_squared);
  const V tension = hn::Mul(hn::LoadU(d, springs.stiffness + e), hn::Sub(length, hn::LoadU(d, springs.rest_length + e)));
  const V per_length = hn::IfThenZeroElse(hn::Eq(length, hn::Zero(d)), hn::Div(tension, length));
  hn::StoreInterleaved4(hn::Mul(per_length, along[0]), hn::Mul(per_length, along[1]),
                        Dimensions == 3 ? hn::Mul(per_length, along[2]) : hn::Zero(d), hn::Zero(d), d, springs.force + 4 * e);
}

template <int Dimensions>
HWY_INLINE void compute_fours(Index count, BlockInFours& springs) {
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> single;
  const Index lanes = static_cast<Index>(hn::Lanes(wide));
  if (count >= lanes) {
    for (Index e = 0; e < count; e += lanes) compute_fours_of<Dimensions>(wide, e + lanes <= count ? e : count - lanes, springs);
  } else {
    for (Index e = 0; e < count; ++e) compute_fours_of<Dimensions>(single, e, springs);
  }
}

// At most `block` springs of a run, as a SpringRun.
struct RunPart {
  Index first, second, count;
};

// The forces of these springs, in the order of add_run.
HWY_INLINE void accumulate_fours(const RunPart& run, const double* term, double* f) {
  const Four four;
  double *const first = f + 4 * run.first, *const second = f + 4 * run.second;
  if (run.second == run.first + 1) {
    auto before = hn::Zero(four);
    for (Index e = 0; e < run.count; ++e) {
      const auto next = hn::LoadU(four, term + 4 * e);
      hn::StoreU(hn::Add(hn::LoadU(four, first + 4 * e), hn::Sub(before, next)), four, first + 4 * e);
      before = next;
    }
    double* const last = first + 4 * run.count;
    hn::StoreU(hn::Add(hn::LoadU(four, last), hn::Sub(before, hn::Zero(four))), four, last);
    return;
  }
  for (Index e = 0; e < run.count; ++e)
    hn::StoreU(hn::Sub(hn::LoadU(four, first + 4 * e), hn::LoadU(four, term + 4 * e)), four, first + 4 * e);
  for (Index e = 0; e < run.count; ++e)
    hn::StoreU(hn::Add(hn::LoadU(four, second + 4 * e), hn::LoadU(four, term + 4 * e)), four, second + 4 * e);
}

template <int Dimensions>
void add_forces_in_fours(const Plan& plan, const double* x, double* f) {
  const Four four;
  HWY_ALIGN double x_of[4 * max_points_in_fours], f_of[4 * max_points_in_fours];
  BlockInFours springs;
  pack_in_fours<Dimensions>(x, plan.points, x_of);
  pack_in_fours<Dimensions>(f, plan.points, f_of);
  RunPart parts[block];
  Index count = 0, part_count = 0;
  const auto add_block = [&]() HWY_ATTR {
    compute_fours<Dimensions>(count, springs);
    const double* term = springs.force;
    for (const RunPart* part = parts; part != parts + part_count; term += 4 * part++->count) accumulate_fours(*part, term, f_of);
    count = part_count = 0;
  };
  for (const SpringRun& run : plan.spring.loose_runs)
    for (Index start = 0; start < run.count; start += block) {
      const RunPart part{run.first + start, run.second + start, HWY_MIN(block, run.count - start)};
      if (count + part.count > block) add_block();
      for (Index e = 0; e < part.count; ++e) {
        springs.stiffness[count + e] = plan.spring.stiffness[run.begin + start + e];
        springs.rest_length[count + e] = plan.spring.rest_length[run.begin + start + e];
        hn::StoreU(hn::Sub(hn::LoadU(four, x_of + 4 * (part.first + e)), hn::LoadU(four, x_of + 4 * (part.second + e))), four,
                   springs.along + 4 * (count + e));
      }
      count += part.count;
      parts[part_count++] = part;
    }
  if (count > 0) add_block();
  unpack_from_fours<Dimensions>(f_of, plan.points, f);
}
#endif

template <int Dimensions, bool Damped>
void add_forces(const Plan& plan, const double* x, const double* v, double* f) {
#if HWY_TARGET != HWY_SCALAR && HWY_MAX_BYTES >= 32
  if constexpr (!Damped) {
    if (is_in_fours(plan)) return add_forces_in_fours<Dimensions>(plan, x, f);
  }
#endif
  HWY_ALIGN double force[3][block + 2 * padding] = {};
  const SpringRun* const end = plan.spring.loose_runs.data() + plan.spring.loose_runs.size();
  for (const SpringRun* run = plan.spring.loose_runs.data(); run != end;) {
    if (is_gathered(*run))
      run = add_short_runs<Dimensions, Damped>(plan, run, end, x, v, f, force);
    else
      add_run<Dimensions, Damped>(plan, *run++, x, v, f, force);
  }
}

void add_forces_2d(const Plan& plan, const double* x, const double* v, double* f) { add_forces<2, false>(plan, x, v, f); }
void add_forces_3d(const Plan& plan, const double* x, const double* v, double* f) { add_forces<3, false>(plan, x, v, f); }
void add_damped_forces_2d(const Plan& plan, const double* x, const double* v, double* f) { add_forces<2, true>(plan, x, v, f); }
void add_damped_forces_3d(const Plan& plan, const double* x, const double* v, double* f) { add_forces<3, true>(plan, x, v, f); }

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(add_forces_2d);
HWY_EXPORT(add_forces_3d);
HWY_EXPORT(add_damped_forces_2d);
HWY_EXPORT(add_damped_forces_3d);

void add_loose_spring_forces(const Plan& plan, const double* x, const double* v, double* f) {
  if (plan.spring.loose_runs.empty()) return;
  if (plan.dimensions == 2)
    v != nullptr ? HWY_DYNAMIC_DISPATCH(add_damped_forces_2d)(plan, x, v, f) : HWY_DYNAMIC_DISPATCH(add_forces_2d)(plan, x, v, f);
  else
    v != nullptr ? HWY_DYNAMIC_DISPATCH(add_damped_forces_3d)(plan, x, v, f) : HWY_DYNAMIC_DISPATCH(add_forces_3d)(plan, x, v, f);
}

void add_spring_forces(const Plan& plan, const double* x, const double* v, double* f) {
  add_loose_spring_forces(plan, x, v, f);
  for (const Grid& grid : plan.spring.grids) add_grid_forces(plan, grid, x, v, f);
}

}  // namespace hooke
#endif
