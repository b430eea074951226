// Which features of a surface are near each other in each substep.
#pragma once

#include <algorithm>
#include <exception>
#include <span>
#include <vector>

#include "sim/contact/closest_kernel.h"
#include "sim/contact/key_kernel.h"
#include "sim/contact/surface/surface_sides.h"
#include "sim/contact/surface/surface_tree.h"

namespace hooke {

struct Plan;

// Leaves of the tree form groups, two of them each, which are listed if they may come near each other before a leaf has moved by some
// margin. Within a group, pairs of features are listed only when they may be near, and their distances are computed only when they may have
// become near: by then, points of one leaf must have moved that far relative to those of the other. What is found depends neither on the
// margins nor on what was found before.
//
// Groups form sections, which the threads of a plan work on side by side. What is found does not depend on their number.
class SurfaceSearch {
 public:
  // [1], of the length of the edges.
  explicit SurfaceSearch(double relative_margin) : relative_margin_(relative_margin) {}

  // Two features at the start of the substep.
  struct Near {
    Index pair = 0, group = 0;  // of those of a section
    double distance = 0.0;      // [m], of spheres from their centers
    Index closest = no_index;   // of those of a section; no_index: another pair touches in the same place
  };

  void clear() { tree_.clear(); }
  bool is_begun() const { return tree_.is_built(); }
  // The points of the surface of the plan are at x. What is crossed is left alone.
  void begin_frame(const Plan& plan, std::span<const Vec3> x);

  // At the start of a substep of h [s], in which points move with u [m/s], from where they are, x.
  void begin_substep(const Plan& plan, std::span<const Vec3> x, std::span<const Vec3> u, double h);
  // Finds the pairs closer than their part of the thickness, a tenth of it and the displacement of their leaves relative to each other.
  // False: there are too many.
  bool find_near(const Plan& plan, std::span<const Vec3> x);
  // Points move with another velocity in the substep. Finds what may collide then in addition. False: there are too many.
  bool change_path(const Plan& plan, std::span<const Vec3> x, std::span<const Vec3> u);

  // visit(pair, distance) for those that may approach each other by this part of their distance in the substep or more, in an order that
  // depends on the places at the start of the frame alone.
  template <class Visit>
  void visit_approaching(const SurfacePlan& plan, FeaturePair kind, double part, const Visit& visit) const {
    visit_near(kind, [&](const PairList& list, const Near& near, double approach) {
      if (part * near.distance <= approach) visit(list.pairs.pair(plan, kind, static_cast<std::size_t>(near.pair)), near.distance);
    });
  }
  // visit(pair, closest, approach) for those that may touch, in the same order: they approach each other at most by the last one [m]. Where
  // the closest point of an edge of a face is its end, or that of a face belongs to another one, other pairs touch in the same place.
  template <class Visit>
  void visit_touching(const SurfacePlan& plan, FeaturePair kind, const Visit& visit) const {
    visit_near(kind, [&](const PairList& list, const Near& near, double approach) {
      if (near.closest != no_index)
        visit(list.pairs.pair(plan, kind, static_cast<std::size_t>(near.pair)), list.closest[near.closest], approach);
    });
  }
  bool is_any_near() const;
  // Beyond the thickness, up to which those that may approach each other by that are near [m].
  double max_gap(double approach) const { return reach_ - max_thickness_ + approach; }
  // The part of the thickness at which two features touch.
  double part(const SurfacePair& pair) const { return part(pair.kind, pair.features); }

  long crossings() const { return crossings_; }  // at the start of this frame
  long searches() const;                         // of groups, and of pairs in a group, in this frame
  long tests() const;                            // distances and groups that were examined, in this substep
  long candidates() const;                       // pairs

 private:
  static constexpr double round_off = 1e-12;  // [m]
  struct Group {
    Index first = 0, second = 0;          // leaves
    std::array<Index, 2> begin{}, end{};  // of the pairs of each kind, of the section
    double travel = 0.0;                  // [m], by which points of one have moved relative to those of the other
    double next = 0.0;                    // [m], the lowest key, or less
    double listed = 0.0;                  // [m]: pairs with lower keys are listed
    double approach = 0.0;                // [m], in this substep
    double need = 0.0;                    // [m]: closer pairs are near

    double limit() const { return need + travel + round_off; }  // [m], of the keys of pairs that may be near
    std::size_t pairs(std::size_t kind) const { return static_cast<std::size_t>(end[kind] - begin[kind]); }
  };
  // Of one kind.
  struct PairList {
    SurfacePairs pairs, kept_pairs;
    // With what thin ones may be closer added.
    std::vector<double> keys,
        kept_keys;          // [m], of the pairs: their distance, of spheres from all of them, is at least that less the travel of the group
    std::size_t count = 0;  // of the pairs, those of a group
    std::vector<KeyRange> awake;  // of the groups that have pairs which may be near
    std::vector<KeyPlace> woken;  // those pairs
    std::vector<Near> near;
    std::vector<Closest> closest;  // of those that may touch
    // of groups that are searched: pairs whose boxes are close, and their distances [m]
    std::vector<double> distances;
    std::vector<Index> kept;  // of them, those that are listed
  };
  struct Searched {
    Index group = 0;
    double reach = 0.0;          // [m]
    std::array<Index, 2> end{};  // of what was found, of each kind
  };
  // Of the groups whose first leaf is in a range. Threads change nothing else side by side.
  struct alignas(64) Section {
    std::vector<std::array<Index, 2>> leaf_pairs;
    std::vector<Group> groups, old_groups;  // in ascending order of their leaves
    std::array<PairList, 2> lists;
    PairsByKind found;
    std::vector<Searched> searched;
    long searches = 0, tests = 0;
    std::exception_ptr failure;

    void forget();
    std::size_t listed() const { return lists[0].count + lists[1].count; }
  };

  // By how much less than the thickness they may be apart [m].
  double thinner(FeaturePair kind, const std::array<Index, 2>& features) const { return (1.0 - part(kind, features)) * max_thickness_; }
  double part(FeaturePair kind, const std::array<Index, 2>& features) const {
    return kind == FeaturePair::PointFace ? 1.0 : std::min(sides_.part(features[0]), sides_.part(features[1]));
  }
  template <class Use>
  void for_sections(const Plan& plan, const Use& use);
  Vec3 fit_boxes(const Plan& plan, std::span<const Vec3> field, std::vector<SurfaceBox>& boxes) const;
  Vec3 center_of(std::span<const SurfaceBox> boxes) const;
  template <class Visit>
  void visit_near(FeaturePair kind, const Visit& visit) const {
    const auto k = static_cast<std::size_t>(kind);
    for (const Section& section : sections_)
      for (const Near& near : section.lists[k].near) visit(section.lists[k], near, section.groups[near.group].approach);
  }
  void find_approach(Group& group) const;
  void move_groups(const Plan& plan, std::span<const Vec3> x);
  void find_bends(const Plan& plan, std::span<const Vec3> x);
  bool is_covered() const;
  void find_groups(const Plan& plan, std::span<const Vec3> x);
  void renew_groups(Section& section) const;
  void find_pairs(const Plan& plan, Section& section, Index g);
  void list_found(const SurfacePlan& plan, std::span<const Vec3> x, Section& section);
  static void compact(Section& section, std::size_t kind);
  void mark(const Group& group);
  void refit_marked(const Plan& plan, std::span<const Vec3> x);
  void wake(const SurfacePlan& plan, std::span<const Vec3> x, Section& section, FeaturePair kind);
  static void note_next(Section& section);
  void measure(const SurfacePlan& plan, std::span<const Vec3> x, Section& section, FeaturePair kind, std::span<const KeyPlace> woken);
  bool collect(const Plan& plan, std::span<const Vec3> x);
  bool change_velocities(std::span<const Vec3> u);

  double relative_margin_;
  double h_ = 0.0;                                                               // [s]
  double max_thickness_ = 0.0, reach_ = 0.0, margin_ = 0.0, leaf_margin_ = 0.0;  // [m]
  SurfaceTree tree_;
  SurfaceSides sides_;
  bool has_springs_ = false;  // whether edges are on no face
  // Per point, by the crossings at the start of the frame on whose edge or face it is; empty: there are none. What passes through a face is
  // left alone: springs, or faces if it is the edge of one.
  std::vector<LeftOut> left_out_;
  long crossings_ = 0;
  std::vector<Vec3> last_, u_;    // places at the start of the substep, and velocities in it [m/s]
  std::vector<char> is_changed_;  // per point, whether that is another one

  // per leaf
  std::vector<SurfaceBox> velocity_;           // [m/s], of the points, in this substep
  Vec3 mean_{0.0};                             // [m/s], about, of all
  std::vector<char> has_changed_;              // whether the velocity has
  std::vector<SurfaceBox> place_boxes_, fat_;  // where the points were, and may be until groups are found anew
  std::vector<SurfaceBox> moved_;              // [m], displacements since then, apart from a common translation
  std::vector<double> reserve_;                // [m], by which points may move in a substep
  std::vector<char> is_marked_;                // whether the boxes of its features are needed
  std::vector<long> fitted_;                   // the substep in which they were computed

  bool has_groups_ = false;
  std::vector<Section> sections_;
  long substep_ = 0, searches_ = 0, tests_ = 0;
};

}  // namespace hooke
