#include "sim/contact/surface/surface_search.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/contact/pair_solver.h"

namespace hooke {
namespace {

constexpr double round_off = 1e-12;  // [m]
// [1], of the thickness: how far beyond it what may be pushed towards each other is near.
constexpr double slack = 0.1;
// [1], of the length of the edges, in units of the relative margin: by how much a leaf may move before groups are found anew.
constexpr double leaf_margin = 1.5;
// Substeps, from one search of bent edges to the next.
constexpr long bend_interval = 16;
// The part of the distance that paths may use (free_part).
constexpr double usable = 0.9;

// The longest vector to a corner of the box.
double max_length(const SurfaceBox& box, const Vec3& from) {
  const Vec3 d = glm::max(glm::abs(box.min - from), glm::abs(box.max - from));
  return std::sqrt(glm::dot(d, d));
}

// The longest between a vector in one and a vector in the other box.
double max_difference(const SurfaceBox& a, const SurfaceBox& b) {
  const double x = std::max(a.max.x - b.min.x, b.max.x - a.min.x), y = std::max(a.max.y - b.min.y, b.max.y - a.min.y),
               z = std::max(a.max.z - b.min.z, b.max.z - a.min.z);
  return std::sqrt(x * x + y * y + z * z);
}

double distance_between(const SurfaceBox& a, const SurfaceBox& b) {
  const Vec3 d = glm::max(Vec3(0.0), glm::max(a.min - b.max, b.min - a.max));
  return std::sqrt(glm::dot(d, d));
}

SurfaceBox box_around(std::span<const Vec3> field, std::span<const Index> points) {
  Vec3 min = field[points[0]], max = min;
  for (const Index i : points.subspan(1)) {
    const Vec3& v = field[i];
    min = {std::min(min.x, v.x), std::min(min.y, v.y), std::min(min.z, v.z)};
    max = {std::max(max.x, v.x), std::max(max.y, v.y), std::max(max.z, v.z)};
  }
  return {min, max};
}

}  // namespace

void SurfaceSearch::begin_frame(const SurfacePlan& plan, std::span<const Vec3> x) {
  tree_.build(plan, x);
  sides_.plan(plan);
  is_pierced_.assign(x.size(), 0);
  for (const Crossing& crossing : tree_.find_crossings(plan, x).found) {
    for (const Index i : plan.edges[crossing.edge]) is_pierced_[i] = 1;
    for (const Index i : plan.pieces[crossing.face].points) is_pierced_[i] = 1;
  }
  max_thickness_ = plan.max_thickness;
  reach_ = (1.0 + slack) * max_thickness_;
  margin_ = std::max(relative_margin_ * plan.edge_length, 0.1 * reach_);
  leaf_margin_ = std::max(leaf_margin * relative_margin_ * plan.edge_length, 0.1 * reach_);
  groups_.clear();
  pairs_.clear();
  keys_.clear();
  forgotten_ = 0;
  has_groups_ = false;
  fitted_.assign(tree_.leaf_count(), 0);
  placed_ = fitted_;
  last_.assign(x.begin(), x.end());
  substep_ = searches_ = 0;
}

// The values of a field at the points of each leaf. Returns about the mean of all.
Vec3 SurfaceSearch::fit_boxes(std::span<const Vec3> field, std::vector<SurfaceBox>& boxes) const {
  boxes.resize(tree_.leaf_count());
  Vec3 sum(0.0);
  for (Index leaf = 0; leaf < tree_.leaf_count(); ++leaf) {
    boxes[leaf] = box_around(field, tree_.points_of(leaf));
    sum += boxes[leaf].min + boxes[leaf].max;
  }
  return sum / (2.0 * static_cast<double>(tree_.leaf_count()));
}

// By how much points of both leaves may approach each other in the substep [m].
void SurfaceSearch::find_approaches() {
  for (Group& group : groups_) group.approach = h_ * max_difference(velocity_[group.first], velocity_[group.second]);
}

// Since the start of the last substep.
void SurfaceSearch::move_groups(std::span<const Vec3> x) {
  for (std::size_t k = 0; k < x.size(); ++k) last_[k] = x[k] - last_[k];
  const Vec3 mean = fit_boxes(last_, shift_);
  last_.assign(x.begin(), x.end());
  for (Group& group : groups_) group.travel += max_difference(shift_[group.first], shift_[group.second]) + round_off;
  for (std::size_t leaf = 0; leaf < moved_.size(); ++leaf) {
    moved_[leaf].min += shift_[leaf].min - mean - round_off;
    moved_[leaf].max += shift_[leaf].max - mean + round_off;
  }
}

void SurfaceSearch::begin_substep(const SurfacePlan& plan, std::span<const Vec3> x, std::span<const Vec3> u, double h) {
  tests_ = 0;
  move_groups(x);
  if (substep_ % bend_interval == 0) find_bends(plan, x);
  ++substep_;
  h_ = h;
  mean_ = fit_boxes(u, velocity_);
  if (!is_covered()) find_groups(x);
  tests_ += static_cast<long>(groups_.size() / 8);
}

void SurfaceSearch::find_bends(const SurfacePlan& plan, std::span<const Vec3> x) {
  for (std::size_t p = 0; p < pairs_.size(); ++p) keys_[p] -= thinner(pairs_[p]);
  sides_.find_bends(plan, x);
  for (std::size_t p = 0; p < pairs_.size(); ++p) keys_[p] += thinner(pairs_[p]) - round_off;
  for (Group& group : groups_) group.next = 0.0;
}

// Whether all groups are known whose leaves may be near each other in this substep.
bool SurfaceSearch::is_covered() const {
  if (!has_groups_) return false;
  for (std::size_t leaf = 0; leaf < moved_.size(); ++leaf) {
    const SurfaceBox& moved = moved_[leaf];
    const double far = std::max({-moved.min.x, -moved.min.y, -moved.min.z, moved.max.x, moved.max.y, moved.max.z});
    if (!(far <= leaf_margin_) || !(h_ * max_length(velocity_[leaf], mean_) <= usable * reserve_[leaf])) return false;
  }
  return true;
}

void SurfaceSearch::find_groups(std::span<const Vec3> x) {
  ++searches_;
  has_groups_ = true;
  const std::size_t leaves = velocity_.size();
  fit_boxes(x, place_boxes_);
  placed_.assign(leaves, substep_);
  moved_.assign(leaves, {});
  reserve_.resize(leaves);
  fat_.resize(leaves);
  for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
    reserve_[leaf] = 2.0 * h_ * max_length(velocity_[leaf], mean_) / usable + 0.1 * reach_;
    const Vec3 margin(0.5 * reach_ + leaf_margin_ + reserve_[leaf] + round_off);
    fat_[leaf] = {place_boxes_[leaf].min - margin, place_boxes_[leaf].max + margin};
  }
  tree_.find_leaf_pairs(fat_, leaf_pairs_);
  tests_ += static_cast<long>(leaf_pairs_.size() / 4);

  // those known before keep their pairs
  std::swap(groups_, old_groups_);
  groups_.clear();
  auto old = old_groups_.begin();
  for (const auto& leaf_pair : leaf_pairs_) {
    while (old != old_groups_.end() && std::array{old->first, old->second} < leaf_pair) ++old;
    if (old != old_groups_.end() && std::array{old->first, old->second} == leaf_pair) {
      groups_.push_back(*old);
    } else {
      const auto [a, b] = leaf_pair;
      const double distance = distance_between(place_boxes_[a], place_boxes_[b]);
      groups_.push_back({.first = a, .second = b, .next = distance, .listed = distance});
    }
  }
}

// Forgets the pairs that no group has anymore.
void SurfaceSearch::compact() {
  std::size_t count = 0;
  for (const Group& group : groups_) count += static_cast<std::size_t>(group.end - group.begin);
  forgotten_ = pairs_.size() - count;
  if (pairs_.size() < 2 * count + 4096) return;
  forgotten_ = 0;
  kept_pairs_.clear();
  kept_keys_.clear();
  for (Group& group : groups_) {
    const auto begin = static_cast<Index>(kept_pairs_.size());
    kept_pairs_.insert(kept_pairs_.end(), pairs_.begin() + group.begin, pairs_.begin() + group.end);
    kept_keys_.insert(kept_keys_.end(), keys_.begin() + group.begin, keys_.begin() + group.end);
    group.end = begin + (group.end - group.begin);
    group.begin = begin;
  }
  std::swap(pairs_, kept_pairs_);
  std::swap(keys_, kept_keys_);
}

// Of the points of a leaf.
const SurfaceBox& SurfaceSearch::box_of(std::span<const Vec3> x, Index leaf) {
  SurfaceBox& box = place_boxes_[leaf];
  if (placed_[leaf] == substep_) return box;
  placed_[leaf] = substep_;
  box = box_around(x, tree_.points_of(leaf));
  return box;
}

// Those closer than the group needs, with a margin.
void SurfaceSearch::find_pairs(const SurfacePlan& plan, std::span<const Vec3> x, Group& group) {
  // those whose boxes are apart have none
  const double apart = distance_between(box_of(x, group.first), box_of(x, group.second));
  const double reach = group.need + std::max({margin_, std::min(4.0 * group.approach, 2.0 * margin_), 0.1 * group.need});
  forgotten_ += static_cast<std::size_t>(group.end - group.begin);
  group.begin = group.end = static_cast<Index>(pairs_.size());
  if (apart >= group.need + 0.5 * (reach - group.need)) {
    group.listed = apart + group.travel;
    return;
  }
  ++searches_;
  for (const Index leaf : {group.first, group.second}) {
    if (fitted_[leaf] == substep_) continue;
    fitted_[leaf] = substep_;
    tree_.refit_leaf(plan, x, leaf);
  }
  tree_.find_pairs_of(plan, x, group.first, group.second, reach, is_pierced_, pairs_);
  group.end = static_cast<Index>(pairs_.size());
  group.listed = reach + group.travel;
  for (Index p = group.begin; p < group.end; ++p) keys_.push_back(pairs_[p].distance + group.travel + thinner(pairs_[p]));
  tests_ += 4 + group.end - group.begin;
}

void SurfaceSearch::wake(const SurfacePlan& plan, std::span<const Vec3> x, Index g) {
  Group& group = groups_[g];
  const double limit = group.need + group.travel + round_off;
  if (group.next >= limit) return;
  if (group.listed < limit) find_pairs(plan, x, group);

  // without branches, which would be mispredicted
  woken_.resize(static_cast<std::size_t>(group.end - group.begin) + 1);
  std::size_t count = 0;
  double next = group.listed;
  for (Index p = group.begin; p < group.end; ++p) {
    woken_[count] = p;
    count += keys_[p] < limit ? 1 : 0;
    next = std::min(next, keys_[p]);
  }
  group.next = next;
  for (const Index p : std::span(woken_).first(count)) {
    const FeaturePair kind = pairs_[p].kind;
    FeatureBlock& block = block_[static_cast<std::size_t>(kind)];
    place_[static_cast<std::size_t>(kind)][block.count] = {p, g};
    block.points[block.count++] = pairs_[p].points;
    if (block.count == FeatureBlock::capacity) measure(x, kind);
  }
}

void SurfaceSearch::measure(std::span<const Vec3> x, FeaturePair kind) {
  FeatureBlock& block = block_[static_cast<std::size_t>(kind)];
  find_closest(kind, x, block);
  tests_ += block.count;
  for (int i = 0; i < block.count; ++i) {
    const auto [p, g] = place_[static_cast<std::size_t>(kind)][i];
    const Group& group = groups_[g];
    const double thinner_by = thinner(pairs_[p]), distance = block.distance[i];
    keys_[p] = std::max(keys_[p], distance + group.travel + thinner_by);
    if (distance < group.need - thinner_by && distance >= coincident)
      near_[static_cast<std::size_t>(kind)].push_back({.pair = p, .group = g, .closest = block.closest(i)});
  }
  block.count = 0;
}

bool SurfaceSearch::collect(const SurfacePlan& plan, std::span<const Vec3> x) {
  for (auto& near : near_) near.clear();
  compact();
  for (Index g = 0; g < static_cast<Index>(groups_.size()); ++g) {
    wake(plan, x, g);
    if (pairs_.size() > PairSolver::max_pairs + forgotten_) break;
  }
  for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges}) measure(x, kind);
  if (pairs_.size() <= PairSolver::max_pairs + forgotten_) return true;
  has_groups_ = false;
  groups_.clear();
  pairs_.clear();
  keys_.clear();
  for (auto& near : near_) near.clear();
  return false;
}

bool SurfaceSearch::find_near(const SurfacePlan& plan, std::span<const Vec3> x) {
  find_approaches();
  for (Group& group : groups_) group.need = reach_ + group.approach;
  return collect(plan, x);
}

bool SurfaceSearch::change_path(const SurfacePlan& plan, std::span<const Vec3> x, std::span<const Vec3> u) {
  mean_ = fit_boxes(u, velocity_);
  bool is_known = is_covered();
  if (!is_known) find_groups(x);
  find_approaches();
  for (Group& group : groups_) {
    const double need = group.approach / usable + (1.0 - SurfaceSides::min_part) * max_thickness_;
    if (need <= group.need) continue;
    group.need = need;
    is_known = false;
  }
  return is_known || collect(plan, x);
}

}  // namespace hooke
