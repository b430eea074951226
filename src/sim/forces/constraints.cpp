// Compiled once for each vector unit by Highway, which picks one at run time. A vector of springs that share no point gives the same
// result as one by one.
#include "sim/forces/constraints.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/forces/constraints.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "sim/forces/sweep_springs-inl.h"

#ifndef HOOKE_SIM_FORCES_CONSTRAINT_ARGUMENTS
#define HOOKE_SIM_FORCES_CONSTRAINT_ARGUMENTS
namespace hooke {
struct ConstraintArguments {
  const Plan& plan;
  const std::vector<SweepRun>& runs;
  const double *rest_length, *stiffness, *damping;
  double h;
  const double* x;
  double* v;
};
}  // namespace hooke
#endif

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <int Dimensions>
struct ConstraintRun : PointsOfRun<Dimensions> {
  const double *rest_length, *stiffness, *damping;
  double h;
};

template <int Dimensions, bool Damped, class Springs>
HWY_INLINE void project_independent(const ConstraintRun<Dimensions>& run, const Springs& springs) {
  using V = typename Springs::V;
  const auto d = springs.d;
  V along[Dimensions], w[Dimensions], v1[Dimensions], v2[Dimensions];
  for (int c = 0; c < Dimensions; ++c) {
    V x1, x2;
    springs.load_ends(run.x[c], x1, x2);
    springs.load_ends(run.v[c], v1[c], v2[c]);
    w[c] = hn::Sub(v1[c], v2[c]);
    along[c] = hn::Add(hn::Sub(x1, x2), hn::Mul(hn::Set(d, run.h), w[c]));
  }
  const V length_squared = dot<Dimensions>(along, along);
  const V length = hn::Sqrt(length_squared);
  V tension = hn::Mul(springs.load(run.stiffness), hn::Sub(length, springs.load(run.rest_length)));
  if constexpr (Damped) tension = hn::Add(tension, hn::Div(hn::Mul(springs.load(run.damping), dot<Dimensions>(along, w)), length));
  const auto is_zero = hn::Eq(length_squared, hn::Zero(d));
  const V impulse = hn::IfThenZeroElse(is_zero, hn::Div(tension, length));
  apply_impulses(run, springs, impulse, along, v1, v2);
}

template <int Dimensions, bool Damped>
void project_runs(const ConstraintArguments& all) {
  for (const SweepRun& each : all.runs) {
    const SweepRun run = each;
    const ConstraintRun<Dimensions> lists{{all.plan, run, all.x, all.v}, all.rest_length, all.stiffness, all.damping, all.h};
    for_springs(run, [lists](const auto& springs) HWY_ATTR { project_independent<Dimensions, Damped>(lists, springs); });
  }
}

void project_all(const ConstraintArguments& all) {
  if (all.plan.dimensions == 2)
    all.damping != nullptr ? project_runs<2, true>(all) : project_runs<2, false>(all);
  else
    all.damping != nullptr ? project_runs<3, true>(all) : project_runs<3, false>(all);
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <tuple>

namespace hooke {

HWY_EXPORT(project_all);

namespace {

// The first color that neither end has, of which they take note: 64 colors per word.
std::size_t assign_color(std::vector<std::uint64_t>& first, std::vector<std::uint64_t>& second) {
  for (std::size_t word = 0;; ++word) {
    first.resize(std::max(first.size(), word + 1));
    second.resize(std::max(second.size(), word + 1));
    const std::uint64_t free = ~(first[word] | second[word]);
    if (free == 0) continue;
    const std::uint64_t lowest = free & (~free + 1);
    first[word] |= lowest;
    second[word] |= lowest;
    return 64 * word + static_cast<std::size_t>(std::countr_zero(lowest));
  }
}

struct ColoredSpring {
  Index first, second, packed;
  Index color = no_index, block = 0;
  Index offset() const { return second - first; }
};

std::vector<ColoredSpring> springs_of(const Plan& plan) {
  std::vector<ColoredSpring> springs;
  springs.reserve(plan.springs);
  for_each_spring(plan, [&](Index i, Index j, Index s) { springs.push_back({i, j, s}); });
  return springs;
}

// Springs of a grid in one direction share a point only if one is in an even row or column and the other in an odd one.
void color_grid(const Grid& grid, std::vector<ColoredSpring>& springs) {
  constexpr std::array directions = {Grid::Right, Grid::Anti, Grid::Down, Grid::Diagonal};
  for (std::size_t d = 0; d < directions.size(); ++d)
    for (Index r = 0; r < grid.rows; ++r)
      for (Index c = 0; c < grid.columns; ++c) {
        const Index packed = grid.spring[directions[d]][static_cast<std::size_t>(r) * grid.pitch() + c];
        if (packed != no_index) springs[packed].color = static_cast<Index>(2 * d) + (directions[d] == Grid::Right ? c : r) % 2;
      }
}

// One direction of each grid after another, then greedily all others by the distance of their ends in the list of points.
void color(const Plan& plan, std::vector<ColoredSpring>& springs) {
  for (const Grid& grid : plan.spring.grids) color_grid(grid, springs);
  std::vector<std::vector<std::uint64_t>> used_colors(plan.points);
  std::vector<ColoredSpring*> others;
  for (ColoredSpring& spring : springs) {
    if (spring.color == no_index) {
      others.push_back(&spring);
      continue;
    }
    for (const Index end : {spring.first, spring.second}) {
      used_colors[end].resize(1);
      used_colors[end][0] |= std::uint64_t{1} << spring.color;
    }
  }
  std::stable_sort(others.begin(), others.end(), [](const auto* a, const auto* b) { return a->offset() < b->offset(); });
  for (ColoredSpring* spring : others)
    spring->color = static_cast<Index>(assign_color(used_colors[spring->first], used_colors[spring->second]));
}

bool follows(const SweepRun& run, const ColoredSpring& spring) {
  const Index distance = run.count * run.step;
  return spring.first == run.first + distance && spring.second == run.second + distance && spring.packed == run.begin + distance;
}

// Sets where the numbers of the runs begin; returns the size of lists.
std::size_t place_runs(std::vector<SweepRun>& runs) {
  constexpr std::size_t lanes = Grid::lanes;
  std::size_t size = 0;
  for (SweepRun& run : runs) {
    // whole vectors, from cache lines on
    const std::size_t unit = run.count == 1 ? 1 : lanes * (run.step == 2 ? 2 : 1);
    if (unit > 1) size = (size + lanes - 1) / lanes * lanes;
    run.at = size;
    size += (run.place(run.count - 1) - run.at) / unit * unit + unit;
  }
  return size;
}

}  // namespace

// A spring of a block of points connects one of them with one of the same block or the next. In the order of the block plus the color, the
// colors follow each other through the cache, and each point has its springs in the order of the colors: one of a lower color that shares a
// point with another one is in the next block at most. Of springs of the same color, those with consecutive ends, and every other spring of
// a row, form runs.
Constraints::Constraints(const Plan& plan) : Structure(plan) {
  std::vector<ColoredSpring> springs = springs_of(plan);
  color(plan, springs);
  Index points_of_block = 128;
  for (const ColoredSpring& spring : springs) points_of_block = std::max(points_of_block, spring.offset());
  for (ColoredSpring& spring : springs) spring.block = spring.first / points_of_block;
  const auto key = [](const ColoredSpring& s) { return std::tuple(s.block + s.color, s.color, s.offset(), s.first, s.packed); };
  std::sort(springs.begin(), springs.end(), [&](const ColoredSpring& a, const ColoredSpring& b) { return key(a) < key(b); });

  const ColoredSpring* last = nullptr;
  for (const ColoredSpring& spring : springs) {
    const bool continues = last != nullptr && spring.color == last->color && spring.block == last->block && follows(runs_.back(), spring);
    if (continues)
      ++runs_.back().count;
    else
      runs_.push_back(
          {.begin = spring.packed, .first = spring.first, .second = spring.second, .count = 1, .step = spring.offset() == 1 ? 2 : 1});
    last = &spring;
  }
  list_size_ = place_runs(runs_);
}

void Constraints::prepare(const Plan& plan, double h, double phi) {
  for (std::vector<double>* list : {&rest_length_, &stiffness_}) list->assign(list_size_, 0.0);
  damping_.assign(plan.has_dashpots() ? list_size_ : 0, 0.0);
  for (const SweepRun& run : runs_)
    for (Index n = 0; n < run.count; ++n) {
      const Index packed = run.begin + n * run.step, first = run.first + n * run.step, second = run.second + n * run.step;
      const double k = plan.spring.stiffness[packed], d = plan.has_dashpots() ? plan.spring.damping[packed] : 0.0;
      const double factor = phi / (1.0 + phi * (h * k + d) * (plan.inverse_mass[first] + plan.inverse_mass[second]));
      const std::size_t place = run.place(n);
      rest_length_[place] = plan.spring.rest_length[packed];
      stiffness_[place] = factor * k;
      if (plan.has_dashpots()) damping_[place] = factor * d;
    }
}

void Constraints::sweep(const Plan& plan, double h, const Field& x, Field& v) const {
  HWY_DYNAMIC_DISPATCH(project_all)
  ({.plan = plan,
    .runs = runs_,
    .rest_length = rest_length_.data(),
    .stiffness = stiffness_.data(),
    .damping = damping_.empty() ? nullptr : damping_.data(),
    .h = h,
    .x = x.data(),
    .v = v.data()});
}

}  // namespace hooke
#endif
