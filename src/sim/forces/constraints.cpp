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
  std::span<const SweepRun> runs;
  SpringEnds listed;
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

// What the springs of a run read and write, from the first ends on. A copy that vectors cannot be stored to, so that it stays in registers.
template <int Dimensions>
struct ConstraintRun {
  const double *x[Dimensions], *inverse_mass, *rest_length, *stiffness, *damping;
  double* v[Dimensions];
  double h;
  HWY_INLINE ConstraintRun(const ConstraintArguments& all, Index first)
      : inverse_mass(all.plan.inverse_mass.data() + first),
        rest_length(all.rest_length),
        stiffness(all.stiffness),
        damping(all.damping),
        h(all.h) {
    for (int c = 0; c < Dimensions; ++c) {
      const std::size_t at = static_cast<std::size_t>(c) * static_cast<std::size_t>(all.plan.points) + static_cast<std::size_t>(first);
      x[c] = all.x + at;
      v[c] = all.v + at;
    }
  }
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

  V inverse_mass1, inverse_mass2;
  springs.load_ends(run.inverse_mass, inverse_mass1, inverse_mass2);
  const V p1 = hn::Mul(inverse_mass1, impulse), p2 = hn::Mul(inverse_mass2, impulse);
  for (int c = 0; c < Dimensions; ++c)
    springs.store_ends(hn::Sub(v1[c], hn::Mul(p1, along[c])), hn::Add(v2[c], hn::Mul(p2, along[c])), run.v[c]);
}

template <int Dimensions, bool Damped>
void project_runs(const ConstraintArguments& all) {
  for (const SweepRun& each : all.runs) {
    const SweepRun run = each;
    const ConstraintRun<Dimensions> lists(all, run.first);
    for_springs(run, all.listed, [lists](const auto& springs) HWY_ATTR { project_independent<Dimensions, Damped>(lists, springs); });
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

#include "sim/forces/bands.h"

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
  for (const SpringRun& run : plan.spring.runs)
    for (Index e = 0; e < run.count; ++e) springs.push_back({run.first + e, run.second + e, run.begin + e});
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

bool follows(const SweepRun& run, const ColoredSpring& spring, Index step) {
  const Index distance = run.count * step;
  return spring.first == run.first + distance && spring.second == run.second + distance && spring.packed == run.begin + distance;
}

// Of springs of the same color, those with consecutive ends, and every other spring of a row, form runs. Those of runs so short that most
// lanes of a vector would be empty are listed: a run of all of them comes last.
void add_range(std::span<const ColoredSpring> springs, std::vector<SweepRun>& runs, std::vector<ColoredSpring>& listed) {
  constexpr Index min_run = 4;
  const std::size_t listed_before = listed.size();
  for (std::size_t at = 0; at < springs.size();) {
    const ColoredSpring& first = springs[at];
    SweepRun run{.begin = first.packed, .first = first.first, .second = first.second, .count = 1, .step = first.offset() == 1 ? 2 : 1};
    while (at + run.count < springs.size() && follows(run, springs[at + run.count], run.step)) ++run.count;
    if (run.count >= min_run)
      runs.push_back(run);
    else
      listed.insert(listed.end(), springs.begin() + at, springs.begin() + at + run.count);
    at += run.count;
  }
  if (const Index count = static_cast<Index>(listed.size() - listed_before); count > 0) runs.push_back({.count = count, .step = 0});
}

}  // namespace

// A spring of a block of points connects one of them with one of the same block or the next. In the order of the block plus the color, the
// colors follow each other through the cache, and each point has its springs in the order of the colors: one of a lower color that shares a
// point with another one is in the next block at most.
Constraints::Constraints(const Plan& plan) : Structure(plan) {
  std::vector<ColoredSpring> springs = springs_of(plan);
  color(plan, springs);
  Index points_of_block = 128;
  for (const ColoredSpring& spring : springs) {
    points_of_block = std::max(points_of_block, spring.offset());
    colors_ = std::max(colors_, spring.color + 1);
  }
  blocks_ = plan.points / points_of_block + 1;
  for (ColoredSpring& spring : springs) spring.block = spring.first / points_of_block;
  const auto key = [](const ColoredSpring& s) { return std::tuple(s.block + s.color, s.color, s.offset(), s.first, s.packed); };
  std::sort(springs.begin(), springs.end(), [&](const ColoredSpring& a, const ColoredSpring& b) { return key(a) < key(b); });

  ranges_.resize(static_cast<std::size_t>(blocks_) * colors_);
  std::vector<ColoredSpring> listed;
  for (std::size_t begin = 0, end = 0; begin < springs.size(); begin = end) {
    const ColoredSpring& first = springs[begin];
    while (end < springs.size() && springs[end].block == first.block && springs[end].color == first.color) ++end;
    Range& range = ranges_[static_cast<std::size_t>(first.block) * colors_ + first.color];
    range.begin = runs_.size();
    add_range(std::span(springs).subspan(begin, end - begin), runs_, listed);
    range.end = runs_.size();
  }
  list_size_ = place_runs(runs_);
  if (listed.empty()) return;
  for (std::vector<Index>* list : {&listed_, &listed_first_, &listed_second_}) list->assign(list_size_, no_index);
  const ColoredSpring* next = listed.data();
  for (const SweepRun& run : runs_)
    for (Index n = 0; run.step == 0 && n < run.count; ++n, ++next) {
      listed_[run.place(n)] = next->packed;
      listed_first_[run.place(n)] = next->first;
      listed_second_[run.place(n)] = next->second;
    }
}

void Constraints::prepare(const Plan& plan, double h, double phi) {
  for (std::vector<double>* list : {&rest_length_, &stiffness_}) list->assign(list_size_, 0.0);
  damping_.assign(plan.has_dashpots() ? list_size_ : 0, 0.0);
  for (const SweepRun& run : runs_)
    for (Index n = 0; n < run.count; ++n) {
      const auto [packed, first, second] = spring(run, n);
      const double k = plan.spring.stiffness[packed], d = plan.has_dashpots() ? plan.spring.damping[packed] : 0.0;
      const double factor = phi / (1.0 + phi * (h * k + d) * (plan.inverse_mass[first] + plan.inverse_mass[second]));
      const std::size_t place = run.place(n);
      rest_length_[place] = plan.spring.rest_length[packed];
      stiffness_[place] = factor * k;
      if (plan.has_dashpots()) damping_[place] = factor * d;
    }
}

void Constraints::sweep(const Plan& plan, double h, const Field& x, Field& v) const {
  const auto project = [&](std::size_t begin, std::size_t end) {
    const ConstraintArguments arguments{.plan = plan,
                                        .runs = std::span(runs_).subspan(begin, end - begin),
                                        .listed = {listed_first_.data(), listed_second_.data()},
                                        .rest_length = rest_length_.data(),
                                        .stiffness = stiffness_.data(),
                                        .damping = damping_.empty() ? nullptr : damping_.data(),
                                        .h = h,
                                        .x = x.data(),
                                        .v = v.data()};
    HWY_DYNAMIC_DISPATCH(project_all)(arguments);
  };
  // the springs of a color in a block follow those of lower colors in the same block and the two beside it
  const auto project_cells = [&](Index first, Index end, const auto& is_included) {
    for (Index sum = first; sum < end + colors_ - 1; ++sum)
      for (Index c = std::max(Index{0}, sum - end + 1); c < std::min(colors_, sum - first + 1); ++c) {
        const Index block = sum - c;
        if (!is_included(block, c)) continue;
        const Range& range = ranges_[static_cast<std::size_t>(block) * colors_ + c];
        if (range.begin != range.end) project(range.begin, range.end);
      }
  };
  constexpr Index min_springs = 4000;  // some microseconds
  const ThreadTeam::Turn turn(plan.execution.team.get());
  const Index max_parts_of_blocks = std::max(Index{1}, blocks_ / std::max(Index{1}, 2 * colors_));
  const int parts = std::min(count_parts(plan, turn, plan.springs, min_springs), static_cast<int>(max_parts_of_blocks));
  if (parts == 1) return project(0, runs_.size());

  // First what depends on nothing outside of the part: a color less with each block towards the parts beside it. Then the rest around each
  // boundary, which is less than a part wide.
  const auto start = [&](int part) { return start_of_part(part, parts, blocks_); };
  turn.run(parts, [&](int part) {
    const Index first = start(part), end = start(part + 1);
    const bool is_first = part == 0, is_last = part + 1 == parts;
    project_cells(first, end, [=](Index block, Index c) { return (is_first || c <= block - first) && (is_last || c < end - block); });
  });
  turn.run(parts - 1, [&](int part) {
    const Index boundary = start(part + 1);
    project_cells(boundary - colors_, boundary + colors_,
                  [=](Index block, Index c) { return block < boundary ? c >= boundary - block : c > block - boundary; });
  });
}

}  // namespace hooke
#endif
