// Contact between points during a frame: which of them may touch in a substep, and their motion.
#pragma once

#include <span>
#include <vector>

#include "sim/contact/pair_search.h"
#include "sim/contact/touch_simulation.h"
#include "sim/forces/motion.h"

namespace hooke {

// Of the centers [m].
inline double touching_distance(const Plan& plan, const PointPair& pair) {
  return plan.radius[pair.i] + plan.radius[pair.j] + plan.pairs.thickness;
}

// Pairs that come close enough to matter are found once for many substeps, with a margin for each point, and again as soon as a point has
// used up its margin. What a substep does does not depend on the margins, but on its start and the forces of the last one in the frame.
class PairSolver {
 public:
  // More pairs than this within reach of each other in one substep are a failure: of an unstable run, or a substep far too long.
  static constexpr std::size_t max_pairs = 1'000'000;

  // The pairs are found anew: points may have been edited.
  void begin_frame() {
    margin_.clear();
    pairs_.clear();
    has_failed_ = false;
    excess_ = 0;
    simulation_.begin_frame();
  }

  // Corrects the step of h from (x0, v0) to (motion.x, motion.v) for all points that may touch another, contact with obstacles included.
  // Returns whether anything touched. `displaced`: written where there were impacts.
  bool resolve(const Plan& plan, std::span<const Obstacle> obstacles, const Field& x0, const Field& v0, double h, Motion& motion,
               std::span<Vec3> displaced);
  // Per point: not 0, if the last call dealt with it, so that it needs nothing else.
  std::span<const char> involved() const { return is_involved_; }
  // The pairs that may have touched in the last call, in ascending order.
  std::span<const PointPair> near() const { return near_; }
  // [J], of contact in the substep, in addition to that of the forces.
  double work() const { return work_; }
  // [s], since the start of the last substep in which anything touched
  double first_touch() const { return simulation_.first_touch(); }
  double first_impact() const { return simulation_.first_impact(); }
  // Whether the last call gave up: there are too many pairs, or impacts and impulses in this frame.
  bool has_failed() const { return has_failed_; }

 private:
  // What a point does in a substep without contact.
  struct FreeMotion {
    Vec3 displacement{0.0};  // [m]
    double deviation = 0.0;  // [m], from the straight line, and what contact at rest reaches
    double impact = 0.0;     // [m], a bound on how far impacts lead away from that
    double reach() const { return glm::length(displacement) + deviation + impact; }  // [m], from its start
  };

  bool measure(const Plan& plan, std::span<const Obstacle> obstacles, const Field& x0, const Field& v0, double h, const Motion& motion);
  bool is_covered(const Plan& plan, const Field& x0) const;
  bool find_pairs(const Plan& plan, const Field& x0);
  bool involve_pairs(const Plan& plan, const Field& x0);
  void fill(const Plan& plan, std::span<const Obstacle> obstacles, const Field& x0, const Field& v0, double h, const Motion& motion);
  bool is_within_bounds(const Plan& plan, const Field& x0, double h);
  void write(const Plan& plan, Motion& motion, std::span<Vec3> displaced);

  PairSearch search_;
  std::vector<PointPair> pairs_, near_;
  Field found_at_;              // positions at which they were found
  std::vector<double> margin_;  // [m], per point: up to which distance from there they are all; empty: not found in this frame
  std::vector<double> extent_;
  std::vector<FreeMotion> free_;
  std::vector<char> is_involved_;
  std::vector<std::size_t> path_of_;  // per point
  TouchSimulation simulation_;
  long excess_ = 0;  // work of earlier substeps of the frame, beyond what is usual
  bool has_failed_ = false;
  double work_ = 0.0;  // [J]
};

}  // namespace hooke
