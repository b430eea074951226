#include "sim/contact/surface/surface_search.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/contact/pair_solver.h"
#include "sim/contact/surface/surface_sections-inl.h"

namespace hooke {
namespace {

// [1], of the thickness: how far beyond it what may be pushed towards each other is near.
constexpr double slack = 0.1;
// [1], of the length of the edges, in units of the relative margin: by how much a leaf may move before groups are found anew.
constexpr double leaf_margin = 1.5;
// Substeps, from one search of bent edges to the next.
constexpr long bend_interval = 16;
// The part of the distance that paths may use (free_part).
constexpr double usable = 0.9;
// Of a section, so that threads have about equal work.
constexpr Index min_leaves = 16;
constexpr int sections_per_thread = 16;

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

long SurfaceSearch::searches() const {
  long sum = searches_;
  for (const Section& section : sections_) sum += section.searches;
  return sum;
}

long SurfaceSearch::tests() const {
  long sum = tests_;
  for (const Section& section : sections_) sum += section.tests;
  return sum;
}

long SurfaceSearch::candidates() const {
  std::size_t sum = 0;
  for (const Section& section : sections_)
    for (const PairList& list : section.lists) sum += list.pairs.size();
  return static_cast<long>(sum);
}

bool SurfaceSearch::is_any_near() const {
  return std::ranges::any_of(sections_, [](const Section& each) { return !each.lists[0].near.empty() || !each.lists[1].near.empty(); });
}

void SurfaceSearch::begin_frame(const Plan& plan, std::span<const Vec3> x) {
  const SurfacePlan& surface = plan.surface;
  tree_.build(surface, x);
  sides_.plan(surface);
  has_springs_ = std::ranges::find(surface.is_spring, 1) != surface.is_spring.end();
  left_out_.clear();
  const std::vector<Crossing> crossings = tree_.find_crossings(surface, x).found;
  crossings_ = static_cast<long>(crossings.size());
  for (const Crossing& crossing : crossings) {
    left_out_.resize(x.size(), LeftOut::Nothing);
    const LeftOut what = surface.is_spring[crossing.edge] != 0 ? LeftOut::Springs : LeftOut::All;
    for (const Index i : surface.edges[crossing.edge]) left_out_[i] = std::max(left_out_[i], what);
    for (const Index i : surface.pieces[crossing.face].points) left_out_[i] = std::max(left_out_[i], what);
  }
  max_thickness_ = surface.max_thickness;
  reach_ = (1.0 + slack) * max_thickness_;
  margin_ = std::max(relative_margin_ * surface.edge_length, 0.1 * reach_);
  leaf_margin_ = std::max(leaf_margin * relative_margin_ * surface.edge_length, 0.1 * reach_);

  const Index leaves = tree_.leaf_count();
  const int threads = plan.execution.team ? plan.execution.team->size() : 1;
  sections_.resize(threads == 1 ? 1 : std::clamp<Index>(leaves / min_leaves, 1, sections_per_thread * threads));
  for (Section& section : sections_) {
    section.forget();
    section.searches = section.tests = 0;
  }
  has_groups_ = false;
  moved_.clear();
  fitted_.assign(leaves, 0);
  is_marked_.assign(leaves, 0);
  has_changed_.assign(leaves, 0);
  last_.assign(x.begin(), x.end());
  u_.assign(x.size(), Vec3(0.0));
  h_ = 0.0;
  velocity_.assign(leaves, {});
  mean_ = Vec3(0.0);
  substep_ = searches_ = 0;
}

Vec3 SurfaceSearch::center_of(std::span<const SurfaceBox> boxes) const {
  Vec3 sum(0.0);
  for (const SurfaceBox& box : boxes) sum += box.min + box.max;
  return sum / (2.0 * static_cast<double>(boxes.size()));
}

// The values of a field at the points of each leaf. Returns about the mean of all.
Vec3 SurfaceSearch::fit_boxes(const Plan& plan, std::span<const Vec3> field, std::vector<SurfaceBox>& boxes) const {
  boxes.resize(tree_.leaf_count());
  for_parts(plan, tree_.leaf_count(), min_leaves_of_pass, [&](int, Index first, Index end) {
    for (Index leaf = first; leaf < end; ++leaf) boxes[leaf] = box_around(field, tree_.points_of(leaf));
  });
  return center_of(boxes);
}

// By how much points of both leaves may approach each other in the substep.
void SurfaceSearch::find_approach(Group& group) const {
  group.approach = h_ * max_difference(velocity_[group.first], velocity_[group.second]);
}

// Since the start of the last substep: as the velocities in it say, or to other places.
void SurfaceSearch::move_groups(const Plan& plan, std::span<const Vec3> x) {
  bool is_expected = true;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const Vec3 difference = x[k] - last_[k] - h_ * u_[k];
    const double largest = std::max({std::abs(difference.x), std::abs(difference.y), std::abs(difference.z)});
    is_expected = is_expected && largest <= 0.1 * round_off;
  }
  if (!is_expected) {
    for (std::size_t k = 0; k < x.size(); ++k) u_[k] = x[k] - last_[k];
    h_ = 1.0;
    mean_ = fit_boxes(plan, u_, velocity_);
    for (Section& section : sections_)
      for (Group& group : section.groups) find_approach(group);
  }
  last_.assign(x.begin(), x.end());
  for (Section& section : sections_)
    for (Group& group : section.groups) group.travel += group.approach + round_off;
  for (std::size_t leaf = 0; leaf < moved_.size(); ++leaf) {
    moved_[leaf].min += h_ * (velocity_[leaf].min - mean_) - round_off;
    moved_[leaf].max += h_ * (velocity_[leaf].max - mean_) + round_off;
  }
}

void SurfaceSearch::begin_substep(const Plan& plan, std::span<const Vec3> x, std::span<const Vec3> u, double h) {
  tests_ = 0;
  for (Section& section : sections_) section.tests = 0;
  move_groups(plan, x);
  if (substep_ % bend_interval == 0) find_bends(plan, x);
  ++substep_;
  h_ = h;
  u_.assign(u.begin(), u.end());
  mean_ = fit_boxes(plan, u_, velocity_);
  if (!is_covered()) find_groups(plan, x);
  std::size_t groups = 0;
  for (const Section& section : sections_) groups += section.groups.size();
  tests_ += static_cast<long>(groups / 8);
}

void SurfaceSearch::find_bends(const Plan& plan, std::span<const Vec3> x) {
  const auto thin_keys = [&](double sign, double error) {
    for_sections(plan, [&](Section& section) {
      PairList& edges = section.lists[static_cast<std::size_t>(FeaturePair::TwoEdges)];
      for (std::size_t p = 0; p < edges.pairs.size(); ++p)
        edges.keys[p] += sign * thinner(FeaturePair::TwoEdges, edges.pairs.features[p]) - error;
    });
  };
  thin_keys(-1.0, 0.0);
  constexpr Index min_edges = 256;  // some microseconds
  for_parts(plan, static_cast<Index>(plan.surface.edges.size()), min_edges,
            [&](int, Index first, Index end) { sides_.find_bends(plan.surface, x, first, end); });
  thin_keys(1.0, round_off);
  for (Section& section : sections_)
    for (Group& group : section.groups) group.next = 0.0;
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

void SurfaceSearch::find_groups(const Plan& plan, std::span<const Vec3> x) {
  ++searches_;
  has_groups_ = true;
  const std::size_t leaves = velocity_.size();
  fit_boxes(plan, x, place_boxes_);
  moved_.assign(leaves, {});
  reserve_.resize(leaves);
  fat_.resize(leaves);
  for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
    reserve_[leaf] = 2.0 * h_ * max_length(velocity_[leaf], mean_) / usable + 0.1 * reach_;
    const Vec3 radius(tree_.max_radius_of(static_cast<Index>(leaf)));
    place_boxes_[leaf] = {place_boxes_[leaf].min - radius, place_boxes_[leaf].max + radius};
    const Vec3 margin(0.5 * reach_ + leaf_margin_ + reserve_[leaf] + round_off);
    fat_[leaf] = {place_boxes_[leaf].min - margin, place_boxes_[leaf].max + margin};
  }
  tree_.set_leaf_boxes(fat_);
  const auto sections = static_cast<int>(sections_.size());
  for_sections(plan, [&](Section& section) {
    const auto s = static_cast<int>(&section - sections_.data());
    const auto start_of = [&](int of) { return start_of_part(of, sections, static_cast<Index>(leaves)); };
    section.leaf_pairs.clear();
    tree_.find_leaf_pairs(start_of(s), start_of(s + 1), section.leaf_pairs);
    renew_groups(section);
  });
  std::size_t leaf_pairs = 0;
  for (const Section& section : sections_) leaf_pairs += section.leaf_pairs.size();
  tests_ += static_cast<long>(leaf_pairs / 4);
}

// Those known before keep their pairs.
void SurfaceSearch::renew_groups(Section& section) const {
  std::swap(section.groups, section.old_groups);
  section.groups.clear();
  for (PairList& list : section.lists) list.count = 0;
  auto old = section.old_groups.begin();
  const auto end = section.old_groups.end();
  for (const auto& leaf_pair : section.leaf_pairs) {
    while (old != end && std::array{old->first, old->second} < leaf_pair) ++old;
    if (old != end && std::array{old->first, old->second} == leaf_pair) {
      section.groups.push_back(*old);
      for (std::size_t kind = 0; kind < section.lists.size(); ++kind) section.lists[kind].count += old->pairs(kind);
    } else {
      const auto [a, b] = leaf_pair;
      const double distance = distance_between(place_boxes_[a], place_boxes_[b]);
      section.groups.push_back({.first = a, .second = b, .next = distance, .listed = distance});
    }
    find_approach(section.groups.back());
  }
}

bool SurfaceSearch::find_near(const Plan& plan, std::span<const Vec3> x) {
  for_sections(plan, [&](Section& section) {
    for (Group& group : section.groups) {
      find_approach(group);
      group.need = reach_ + group.approach;
      if (std::max(group.next, group.listed) < group.limit()) mark(group);
    }
  });
  return collect(plan, x);
}

// Returns whether any is another one.
bool SurfaceSearch::change_velocities(std::span<const Vec3> u) {
  is_changed_.resize(u.size());
  bool any = false;
  for (std::size_t k = 0; k < u.size(); ++k) {
    is_changed_[k] = u[k] != u_[k] ? 1 : 0;
    any = any || is_changed_[k] != 0;
  }
  std::ranges::fill(has_changed_, 0);
  if (!any) return false;
  u_.assign(u.begin(), u.end());
  for (Index leaf = 0; leaf < tree_.leaf_count(); ++leaf) {
    if (std::ranges::none_of(tree_.points_of(leaf), [&](Index i) { return is_changed_[i] != 0; })) continue;
    has_changed_[leaf] = 1;
    velocity_[leaf] = box_around(u_, tree_.points_of(leaf));
  }
  mean_ = center_of(velocity_);
  return true;
}

bool SurfaceSearch::change_path(const Plan& plan, std::span<const Vec3> x, std::span<const Vec3> u) {
  std::atomic<bool> is_known = true;
  if (change_velocities(u) && !is_covered()) {
    find_groups(plan, x);
    is_known = false;
  }
  for_sections(plan, [&](Section& section) {
    for (Group& group : section.groups) {
      if ((has_changed_[group.first] | has_changed_[group.second]) != 0) find_approach(group);
      const double need = group.approach / usable + (1.0 - SurfaceSides::min_part) * max_thickness_;
      if (need <= group.need) continue;
      group.need = need;
      is_known.store(false, std::memory_order_relaxed);
    }
  });
  if (is_known) return true;
  for (const Section& section : sections_)
    for (const Group& group : section.groups)
      if (std::max(group.next, group.listed) < group.limit()) mark(group);
  return collect(plan, x);
}

}  // namespace hooke
