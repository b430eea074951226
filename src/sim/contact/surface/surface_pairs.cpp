// The part of SurfaceSearch that finds pairs of features.
#include <algorithm>

#include "sim/contact/pair_solver.h"
#include "sim/contact/surface/surface_sections-inl.h"

namespace hooke {

void SurfaceSearch::Section::forget() {
  groups.clear();
  pairs.clear();
  keys.clear();
  for (auto& each : near) each.clear();
  forgotten = listed = 0;
}

// Forgets the pairs that no group has anymore.
void SurfaceSearch::compact(Section& section) {
  std::size_t count = 0;
  for (const Group& group : section.groups) count += static_cast<std::size_t>(group.end - group.begin);
  section.forgotten = section.pairs.size() - count;
  if (section.pairs.size() < 2 * count + 4096) return;
  section.forgotten = 0;
  section.kept_pairs.clear();
  section.kept_keys.clear();
  for (Group& group : section.groups) {
    const auto begin = static_cast<Index>(section.kept_pairs.size());
    const auto keep = [&](auto& kept, const auto& all) { kept.insert(kept.end(), all.begin() + group.begin, all.begin() + group.end); };
    keep(section.kept_pairs, section.pairs);
    keep(section.kept_keys, section.keys);
    group.end = begin + (group.end - group.begin);
    group.begin = begin;
  }
  std::swap(section.pairs, section.kept_pairs);
  std::swap(section.keys, section.kept_keys);
}

// The boxes of the features of both leaves are needed.
void SurfaceSearch::mark(const Group& group) {
  for (const Index leaf : {group.first, group.second}) std::atomic_ref(is_marked_[leaf]).store(1, std::memory_order_relaxed);
}

void SurfaceSearch::refit_marked(const Plan& plan, std::span<const Vec3> x) {
  for_parts(plan, tree_.leaf_count(), min_leaves_of_pass, [&](int, Index first, Index end) {
    for (Index leaf = first; leaf < end; ++leaf) {
      if (is_marked_[leaf] == 0) continue;
      is_marked_[leaf] = 0;
      if (fitted_[leaf] == substep_) continue;
      fitted_[leaf] = substep_;
      place_boxes_[leaf] = tree_.refit_leaf(x, leaf);
    }
  });
}

// Those closer than the group needs, with a margin.
void SurfaceSearch::find_pairs(const Plan& plan, std::span<const Vec3> x, Section& section, Group& group) {
  // those whose boxes are apart have none
  const double apart = distance_between(place_boxes_[group.first], place_boxes_[group.second]);
  const double reach = group.need + std::max({margin_, std::min(4.0 * group.approach, 2.0 * margin_), 0.1 * group.need});
  group.begin = group.end = static_cast<Index>(section.pairs.size());
  if (apart >= group.need + 0.5 * (reach - group.need)) {
    group.listed = apart + group.travel;
    return;
  }
  ++section.searches;
  tree_.find_pairs_of(plan.surface, x, group.first, group.second, reach, is_pierced_, section.pairs);
  group.end = static_cast<Index>(section.pairs.size());
  group.listed = reach + group.travel;
  for (Index p = group.begin; p < group.end; ++p)
    section.keys.push_back(section.pairs[p].distance + group.travel + thinner(section.pairs[p]));
  section.tests += 4 + group.end - group.begin;
}

void SurfaceSearch::wake(const Plan& plan, std::span<const Vec3> x, Section& section, Index g) {
  Group& group = section.groups[g];
  const double limit = group.limit();
  if (group.listed < limit) find_pairs(plan, x, section, group);

  // without branches, which would be mispredicted
  section.woken.resize(std::max(section.woken.size(), static_cast<std::size_t>(group.end - group.begin) + 1));
  std::size_t count = 0;
  double next = group.listed;
  for (Index p = group.begin; p < group.end; ++p) {
    section.woken[count] = p;
    count += section.keys[p] < limit ? 1 : 0;
    next = std::min(next, section.keys[p]);
  }
  group.next = next;
  for (const Index p : std::span(section.woken).first(count)) {
    const FeaturePair kind = section.pairs[p].kind;
    FeatureBlock& block = section.block[static_cast<std::size_t>(kind)];
    section.place[static_cast<std::size_t>(kind)][block.count] = {p, g};
    block.points[block.count++] = section.pairs[p].points;
    if (block.count == FeatureBlock::capacity) measure(x, section, kind);
  }
}

void SurfaceSearch::measure(std::span<const Vec3> x, Section& section, FeaturePair kind) {
  FeatureBlock& block = section.block[static_cast<std::size_t>(kind)];
  find_closest(kind, x, block);
  section.tests += block.count;
  for (int i = 0; i < block.count; ++i) {
    const auto [p, g] = section.place[static_cast<std::size_t>(kind)][i];
    const Group& group = section.groups[g];
    const double thinner_by = thinner(section.pairs[p]), distance = block.distance[i];
    section.keys[p] = std::max(section.keys[p], distance + group.travel + thinner_by);
    if (distance < group.need - thinner_by && distance >= coincident)
      section.near[static_cast<std::size_t>(kind)].push_back({.pair = p, .group = g, .closest = block.closest(i)});
  }
  block.count = 0;
}

// The leaves whose pairs have to be searched are marked.
bool SurfaceSearch::collect(const Plan& plan, std::span<const Vec3> x) {
  refit_marked(plan, x);
  for_sections(plan, [&](Section& section) {
    for (auto& near : section.near) near.clear();
    compact(section);
    section.listed = 0;
    for (Index g = 0; g < static_cast<Index>(section.groups.size()); ++g) {
      const Group& group = section.groups[g];
      if (group.next < group.limit()) wake(plan, x, section, g);
      section.listed += static_cast<std::size_t>(group.end - group.begin);
      if (section.listed > PairSolver::max_pairs) break;
    }
    for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges}) measure(x, section, kind);
  });
  std::size_t listed = 0;
  for (const Section& section : sections_) listed += section.listed;
  if (listed <= PairSolver::max_pairs) return true;
  has_groups_ = false;
  for (Section& section : sections_) {
    section.forget();
    section.searches = section.tests = 0;  // how many there were depends on the sections
  }
  return false;
}

}  // namespace hooke
