// The part of SurfaceSearch that finds pairs of features.
#include <hwy/cache_control.h>
#include <algorithm>

#include "sim/contact/pair_solver.h"
#include "sim/contact/surface/surface_sections-inl.h"

namespace hooke {

void SurfaceSearch::Section::forget() {
  groups.clear();
  for (PairList& list : lists) {
    list.pairs.resize(0);
    list.keys.clear();
    list.near.clear();
    list.closest.clear();
    list.count = 0;
  }
}

// Forgets the pairs that no group has anymore.
void SurfaceSearch::compact(Section& section, std::size_t kind) {
  PairList& list = section.lists[kind];
  if (list.pairs.size() < 2 * list.count + 4096) return;
  list.kept_pairs.resize(0);
  list.kept_keys.clear();
  for (Group& group : section.groups) {
    const auto begin = static_cast<Index>(list.kept_pairs.size());
    const auto keep = [&](auto& kept, const auto& all) {
      kept.insert(kept.end(), all.begin() + group.begin[kind], all.begin() + group.end[kind]);
    };
    keep(list.kept_pairs.points, list.pairs.points);
    keep(list.kept_pairs.features, list.pairs.features);
    keep(list.kept_keys, list.keys);
    group.end[kind] = begin + (group.end[kind] - group.begin[kind]);
    group.begin[kind] = begin;
  }
  list.kept_keys.resize(list.kept_pairs.size() + key_padding);
  std::swap(list.pairs, list.kept_pairs);
  std::swap(list.keys, list.kept_keys);
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

// Those closer than the group needs, with a margin. They are listed by list_found.
void SurfaceSearch::find_pairs(const Plan& plan, Section& section, Index g) {
  Group& group = section.groups[g];
  for (std::size_t kind = 0; kind < section.lists.size(); ++kind) {
    section.lists[kind].count -= group.pairs(kind);
    group.begin[kind] = group.end[kind] = 0;
  }
  // those whose boxes are apart have none
  const double apart = distance_between(place_boxes_[group.first], place_boxes_[group.second]);
  const double reach = group.need + std::max({margin_, std::min(4.0 * group.approach, 2.0 * margin_), 0.1 * group.need});
  if (apart >= group.need + 0.5 * (reach - group.need)) {
    group.listed = apart + group.travel;
    return;
  }
  ++section.searches;
  section.tests += 4;
  group.listed = reach + group.travel;
  tree_.find_pairs_of(plan.surface, group.first, group.second, reach, left_out_, section.found);
  const std::array<Index, 2> end{static_cast<Index>(section.found[0].size()), static_cast<Index>(section.found[1].size())};
  const std::array<Index, 2> begin = section.searched.empty() ? std::array<Index, 2>{} : section.searched.back().end;
  if (end != begin) section.searched.push_back({.group = g, .reach = reach, .end = end});
}

// The pairs of all groups that were searched: measured together, for groups have few.
void SurfaceSearch::list_found(const SurfacePlan& plan, std::span<const Vec3> x, Section& section) {
  for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges}) {
    const auto k = static_cast<std::size_t>(kind);
    PairList& list = section.lists[k];
    SurfacePairs& found = section.found[k];
    list.distances.resize(found.size());
    find_distances(kind, x, found.points, list.distances);
    if (!plan.radius.empty())
      for (std::size_t pair = 0; pair < found.size(); ++pair) list.distances[pair] -= plan.radius_of(found.points[pair]);
    // those that are close enough: without branches, which would be mispredicted
    list.kept.resize(found.size() + 1);
    std::size_t kept = 0, p = 0, i = 0, end = list.pairs.size();
    for (const Searched& searched : section.searched)
      for (; p < static_cast<std::size_t>(searched.end[k]); ++p) {
        list.kept[kept] = static_cast<Index>(p);
        kept += static_cast<std::size_t>(list.distances[p] < searched.reach);
      }
    list.pairs.resize(end + kept);
    list.keys.resize(end + kept + key_padding);
    for (const Searched& searched : section.searched) {
      Group& group = section.groups[searched.group];
      group.begin[k] = static_cast<Index>(end);
      for (; i < kept && list.kept[i] < searched.end[k]; ++i, ++end) {
        const Index from = list.kept[i];
        list.pairs.set(end, found, from);
        list.keys[end] = list.distances[from] + group.travel + thinner(kind, found.features[from]);
      }
      group.end[k] = static_cast<Index>(end);
      list.count += group.pairs(k);
      section.tests += static_cast<long>(group.pairs(k));
    }
    found.resize(0);
  }
  section.searched.clear();
}

// The pairs of the groups that have any which may be near.
void SurfaceSearch::wake(const SurfacePlan& plan, std::span<const Vec3> x, Section& section, FeaturePair kind) {
  const auto k = static_cast<std::size_t>(kind);
  PairList& list = section.lists[k];
  list.awake.clear();
  for (Index g = 0; g < static_cast<Index>(section.groups.size()); ++g) {
    const Group& group = section.groups[g];
    if (group.next < group.limit())
      list.awake.push_back({.begin = group.begin[k], .end = group.end[k], .group = g, .limit = group.limit(), .min = group.listed});
  }
  const std::size_t count = find_below(list.keys, list.awake, list.woken);
  constexpr std::size_t capacity = FeatureBlock::capacity;
  const auto block_from = [&](std::size_t from) {
    from = std::min(from, count);
    return std::span(list.woken).subspan(from, std::min(capacity, count - from));
  };
  for (std::size_t from = 0; from < count; from += capacity) {
    // those of the next block are far apart in a long list
    for (const KeyPlace& place : block_from(from + capacity)) {
      hwy::Prefetch(&list.pairs.points[place.key]);
      hwy::Prefetch(&list.pairs.features[place.key]);
    }
    measure(plan, x, section, kind, block_from(from));
  }
}

void SurfaceSearch::measure(const SurfacePlan& plan, std::span<const Vec3> x, Section& section, FeaturePair kind,
                            std::span<const KeyPlace> woken) {
  PairList& list = section.lists[static_cast<std::size_t>(kind)];
  FeatureBlock block;
  for (const KeyPlace& place : woken) block.points[block.count++] = list.pairs.points[place.key];
  find_closest(kind, x, block);
  section.tests += block.count;
  for (int i = 0; i < block.count; ++i) {
    const auto [p, g] = woken[i];
    const Group& group = section.groups[g];
    const double thinner_by = thinner(kind, list.pairs.features[p]), distance = block.distance[i];
    const double apart = distance - plan.radius_of(block.points[i]);
    list.keys[p] = std::max(list.keys[p], apart + group.travel + thinner_by);
    if (!(apart < group.need - thinner_by && distance >= coincident)) continue;
    Near& near = list.near.emplace_back(Near{.pair = p, .group = g, .distance = distance});
    const bool touches =
        kind == FeaturePair::TwoEdges
            ? block.is_at_end[i] == 0.0 || (has_springs_ && list.pairs.pair(plan, kind, static_cast<std::size_t>(p)).has_spring)
            : sides_.owns(list.pairs.features[p][0], block.weight[1][i], block.weight[2][i], block.weight[3][i]);
    if (!touches) continue;
    near.closest = static_cast<Index>(list.closest.size());
    list.closest.push_back(block.closest(i));
  }
}

// The lowest keys of the groups that were awake.
void SurfaceSearch::note_next(Section& section) {
  const auto& [points, edges] = section.lists;
  for (std::size_t i = 0; i < points.awake.size(); ++i)
    section.groups[points.awake[i].group].next = std::min(points.awake[i].min, edges.awake[i].min);
}

// The leaves whose pairs have to be searched are marked.
bool SurfaceSearch::collect(const Plan& plan, std::span<const Vec3> x) {
  constexpr std::size_t max_found = 8192;  // at once
  refit_marked(plan, x);
  for_sections(plan, [&](Section& section) {
    for (std::size_t kind = 0; kind < section.lists.size(); ++kind) {
      section.lists[kind].near.clear();
      section.lists[kind].closest.clear();
      compact(section, kind);
    }
    for (Index g = 0; g < static_cast<Index>(section.groups.size()); ++g) {
      const Group& group = section.groups[g];
      if (std::max(group.next, group.listed) < group.limit()) find_pairs(plan, section, g);
      if (section.found[0].size() + section.found[1].size() > max_found) list_found(plan.surface, x, section);
      if (section.listed() > PairSolver::max_pairs) break;
    }
    list_found(plan.surface, x, section);
    if (section.listed() > PairSolver::max_pairs) return;
    for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges}) wake(plan.surface, x, section, kind);
    note_next(section);
  });
  std::size_t listed = 0;
  for (const Section& section : sections_) listed += section.listed();
  if (listed <= PairSolver::max_pairs) return true;
  has_groups_ = false;
  for (Section& section : sections_) {
    section.forget();
    section.searches = section.tests = 0;  // how many there were depends on the sections
  }
  return false;
}

}  // namespace hooke
