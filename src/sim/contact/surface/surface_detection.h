// Which features of a surface are near each other in each substep.
#pragma once

#include <span>
#include <vector>

#include "sim/contact/closest.h"
#include "sim/contact/surface/surface_tree.h"

namespace hooke {

// A pair that may touch, at the start of the substep.
struct NearFeatures {
  std::array<Index, 4> points{};
  Closest closest;
  double contact = 0.0;  // [m], the distance at which they touch
  Index pair = 0;        // in the list of its kind
  FeaturePair kind = FeaturePair::PointFace;
};
// A pair that may meet within the substep.
struct MeetingFeatures {
  FeaturePair kind = FeaturePair::PointFace;
  std::array<Index, 4> points{};
  double distance = 0.0;  // [m], at its start
};

// Pairs are listed with a margin for many substeps. A listed pair sleeps until points have moved so far, relative to their mean, that it
// may be near. What is found depends neither on the margin nor on what was found before.
class SurfaceDetection {
 public:
  // More pairs than this are a failure: of an unstable run, or a substep far too long.
  static constexpr std::size_t max_pairs = 1'000'000;

  // `relative_margin`: [1], of the length of the edges.
  explicit SurfaceDetection(double relative_margin) : relative_margin_(relative_margin) {}

  void clear() { tree_.clear(); }
  bool is_begun() const { return tree_.is_built(); }
  // The points of the surface are at x. What is crossed is left alone.
  void begin_frame(const SurfacePlan& plan, std::span<const Vec3> x);

  // Points are at x at the start of a substep of h [s], in which they move with u [m/s]. Finds the pairs that are closer than their
  // thickness, a part of it, and what they may approach each other by. False: there are too many.
  bool find_near(const SurfacePlan& plan, std::span<const Vec3> x, std::span<const Vec3> u, double h);
  // They move with other velocities instead. False: there are too many.
  bool change_velocities(const SurfacePlan& plan, std::span<const Vec3> u);

  // Without those in whose place another pair touches.
  std::span<const NearFeatures> near() const { return near_; }
  std::span<const MeetingFeatures> meeting() const { return meeting_; }
  // [m], by which any two features approach each other in the substep at most.
  double approach() const { return approach_; }
  // The list in which NearFeatures::pair is valid.
  long list_number() const { return lists_; }

  long crossings() const { return crossings_; }           // at the start of the frame
  long searches() const { return lists_ - first_list_; }  // in this frame
  long tests() const { return tests_; }                   // distances and blocks that were examined, in this substep

 private:
  bool update(const SurfacePlan& plan);
  bool list_pairs(const SurfacePlan& plan, double need);
  void wake(const SurfacePlan& plan, FeaturePair kind, double need);
  void measure(const SurfacePlan& plan, FeaturePair kind, std::span<const Index> woken, double need);

  double relative_margin_;
  SurfaceTree tree_;
  std::vector<LeftOut> left_out_;  // per point, by what is crossed at the start of the frame; empty: nothing is
  SurfacePairs pairs_;
  std::array<std::vector<double>, 2> keys_;  // [m], of each pair: the distance when it was measured, plus the travel of that time
  double reach_ = 0.0, travel_ = 0.0;        // [m]: pairs up to the first are listed; by the second, distances have changed since at most
  double h_ = 0.0, approach_ = 0.0, round_off_ = 0.0;
  std::vector<Vec3> x_;
  std::vector<NearFeatures> near_;
  std::vector<MeetingFeatures> meeting_;
  FeatureBlock block_;
  long crossings_ = 0, lists_ = 0, first_list_ = 0, tests_ = 0;
};

}  // namespace hooke
