// Which features of a surface are near each other in each substep.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "sim/contact/closest_kernel.h"
#include "sim/contact/surface/surface_sides.h"
#include "sim/contact/surface/surface_tree.h"

namespace hooke {

// Leaves of the tree form groups, two of them each, which are listed if they may come near each other before a leaf has moved by some
// margin. Within a group, pairs of features are listed only when they may be near, and their distances are computed only when they may have
// become near: by then, points of one leaf must have moved that far relative to those of the other. What is found depends neither on the
// margins nor on what was found before.
class SurfaceSearch {
 public:
  // [1], of the length of the edges.
  explicit SurfaceSearch(double relative_margin) : relative_margin_(relative_margin) {}

  // Two features at the start of the substep.
  struct Near {
    Index pair = 0, group = 0;
    Closest closest;
  };

  void clear() { tree_.clear(); }
  bool is_begun() const { return tree_.is_built(); }
  // The points of the plan are at x. Those on crossings are left alone.
  void begin_frame(const SurfacePlan& plan, std::span<const Vec3> x);

  // At the start of a substep of h [s], in which points move with u [m/s], from where they are, x.
  void begin_substep(const SurfacePlan& plan, std::span<const Vec3> x, std::span<const Vec3> u, double h);
  // Finds the pairs closer than their part of the thickness, a tenth of it and the displacement of their leaves relative to each other.
  // False: there are too many.
  bool find_near(const SurfacePlan& plan, std::span<const Vec3> x);
  // Points move with another velocity in the substep. Finds what may collide then in addition. False: there are too many.
  bool change_path(const SurfacePlan& plan, std::span<const Vec3> x, std::span<const Vec3> u);

  // In an order that depends on the places at the start of the frame alone.
  std::span<const Near> near(FeaturePair kind) const { return near_[static_cast<std::size_t>(kind)]; }
  bool is_any_near() const { return !near_[0].empty() || !near_[1].empty(); }
  const SurfacePair& pair(const Near& near) const { return pairs_[near.pair]; }
  // By which they approach each other at most in the substep [m].
  double approach(const Near& near) const { return groups_[near.group].approach; }
  // Beyond the thickness, up to which they are near [m].
  double max_gap(const Near& near) const { return reach_ - max_thickness_ + approach(near); }
  const SurfaceSides& sides() const { return sides_; }
  // The part of the thickness at which two features touch.
  double part(const SurfacePair& pair) const {
    return pair.kind == FeaturePair::PointFace ? 1.0 : std::min(sides_.part(pair.features[0]), sides_.part(pair.features[1]));
  }

  long searches() const { return searches_; }  // of groups, and of pairs in a group, in this frame
  long tests() const { return tests_; }        // distances and groups that were examined, in this substep
  long candidates() const { return static_cast<long>(pairs_.size()); }

 private:
  struct Group {
    Index first = 0, second = 0;  // leaves
    Index begin = 0, end = 0;     // of pairs_
    double travel = 0.0;          // [m], by which points of one have moved relative to those of the other
    double next = 0.0;            // [m], the lowest key, or less
    double listed = 0.0;          // [m]: pairs with lower keys are listed
    double approach = 0.0;        // [m], in this substep
    double need = 0.0;            // [m]: closer pairs are near
  };
  struct Place {
    Index pair = 0, group = 0;
  };

  // By how much less than the thickness they may be apart [m].
  double thinner(const SurfacePair& pair) const { return (1.0 - part(pair)) * max_thickness_; }
  const SurfaceBox& box_of(std::span<const Vec3> x, Index leaf);
  Vec3 fit_boxes(std::span<const Vec3> field, std::vector<SurfaceBox>& boxes) const;
  void find_approaches();
  void move_groups(std::span<const Vec3> x);
  void find_bends(const SurfacePlan& plan, std::span<const Vec3> x);
  bool is_covered() const;
  void find_groups(std::span<const Vec3> x);
  void find_pairs(const SurfacePlan& plan, std::span<const Vec3> x, Group& group);
  void compact();
  void wake(const SurfacePlan& plan, std::span<const Vec3> x, Index g);
  void measure(std::span<const Vec3> x, FeaturePair kind);
  bool collect(const SurfacePlan& plan, std::span<const Vec3> x);

  double relative_margin_;
  double h_ = 0.0;                                                               // [s]
  double max_thickness_ = 0.0, reach_ = 0.0, margin_ = 0.0, leaf_margin_ = 0.0;  // [m]
  SurfaceTree tree_;
  SurfaceSides sides_;
  std::vector<char> is_pierced_;  // per point, whether it is on an edge or face of a crossing at the start of the frame
  std::vector<Vec3> last_;        // places at the start of the substep

  // per leaf
  std::vector<SurfaceBox> velocity_;           // [m/s], of the points, in this substep
  Vec3 mean_{0.0};                             // [m/s], about, of all
  std::vector<SurfaceBox> place_boxes_, fat_;  // where the points were, and may be until groups are found anew
  std::vector<SurfaceBox> shift_, moved_;      // [m], displacements in the last substep, and since then, apart from a common translation
  std::vector<double> reserve_;                // [m], by which points may move in a substep
  std::vector<long> fitted_, placed_;          // the substep in which the boxes of its features were computed, and its own

  bool has_groups_ = false;
  std::vector<std::array<Index, 2>> leaf_pairs_;
  std::vector<Group> groups_, old_groups_;  // in ascending order of their leaves
  std::vector<SurfacePair> pairs_, kept_pairs_;
  std::size_t forgotten_ = 0;  // of these, those of no group anymore
  // With what thin ones may be closer added.
  std::vector<double> keys_, kept_keys_;  // [m], of the pairs: their distance is at least that less the travel of the group
  std::vector<Index> woken_;              // pairs of a group that may be near
  std::array<FeatureBlock, 2> block_;     // of pairs of each kind that are not measured yet
  std::array<std::array<Place, FeatureBlock::capacity>, 2> place_{};
  std::array<std::vector<Near>, 2> near_;
  long substep_ = 0, searches_ = 0, tests_ = 0;
};

}  // namespace hooke
