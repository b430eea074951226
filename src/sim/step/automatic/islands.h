// Parts of a scene that no spring joins and that do not touch each other move independently. Where their stability requires very different
// steps, the method `auto` chooses method and substeps for each group of parts with similar ones.
#pragma once

#include <span>
#include <vector>

#include "sim/plan/plan.h"
#include "sim/step/step.h"

namespace hooke {

// A frame of a scene, group by group.
class IslandFrames {
 public:
  // Divides the scene, again if it changed since the last call. False if it is stepped as a whole: its parts require similar steps, or they
  // may affect each other, by contact, the hand, listed forces or springs that break.
  bool divide(const Plan& plan, const System& system, double frame_rate);
  std::size_t count() const { return groups_.size(); }

  // The settings are those of `auto`, or have the steps of each group. Writes what was chosen to `memory`.
  void begin(const Settings& settings, const State& state, MethodMemory& memory);
  // A substep of one of the groups.
  void substep();
  bool done() const { return next_ == groups_.size() || failure_ != StepFailure::None; }
  StepFailure failure() const { return failure_; }
  bool has_touched() const;
  // Writes positions and velocities, and adds what was counted.
  void end(const Plan& plan, Motion& motion);

  // [ms], by the model of the cost: of the frame, and of what was computed on copies so far and not used.
  double cost() const;
  double trial_cost() const;

 private:
  struct Group {
    System system;
    Plan plan;
    std::vector<Index> points;   // of the scene
    double expected_cost = 0.0;  // [1], relative to that of all groups
    State state;
    Frame frame;
  };
  void rebuild(const System& system, std::span<const int> group_of_point);

  std::vector<Group> groups_;
  std::size_t next_ = 0;  // the group that is computed
  StepFailure failure_ = StepFailure::None;
  // of the last division
  std::vector<Index> root_;    // of each point of the Plan, the first of those connected with it
  bool is_connected_ = false;  // the scene has one part
  Index points_ = -1;
  int dimensions_ = 0;
  std::vector<SpringRun> runs_;
  std::vector<Index> point_index_;  // Plan::point_index
  std::vector<Collider> colliders_;
  double rates_ = 0.0, drag_ = 0.0, frame_rate_ = 0.0;
  Vec3 gravity_{0.0};
  double past_trial_cost_ = 0.0;  // [ms], of earlier groups
};

}  // namespace hooke
