// One frame of a scene, substep by substep.
#pragma once

#include <memory>
#include <span>

#include "sim/forces/motion.h"
#include "sim/model/settings.h"
#include "sim/model/state.h"
#include "sim/step/automatic/automatic.h"
#include "sim/step/substep.h"
#include "sim/step/supply.h"

namespace hooke {

class IslandFrames;

// A frame in progress. Reused from frame to frame, so that stepping does not allocate:
//   frame.begin(plan, system, settings, state); while (!frame.done()) frame.substep(plan); frame.end(plan, state);
// Between begin and end only the frame may change the plan: the k and d of springs that break become zero, until the plan is
// rebuilt or refreshed. The State is not changed.
class Frame {
 public:
  Frame();
  ~Frame();
  Frame(Frame&& other) noexcept;
  Frame& operator=(Frame&& other) noexcept;

  // Sets the motion of the hand and packs the state. The plan must be current.
  void begin(Plan& plan, const System& system, const Settings& settings, const State& state);
  // One substep; where nothing acts between them several, as many in every run; or, of an adaptive method, one of its own steps, so that
  // the time that a call takes is bounded.
  void substep(Plan& plan);
  bool done() const { return substeps_done_ >= substeps_ || failure() != StepFailure::None; }
  // Why the frame ended early; its state is then one within the frame.
  StepFailure failure() const;
  int substeps_done() const { return substeps_done_; }
  double duration() const { return duration_; }  // [s]
  // Whether any point touched a collider or another point.
  bool has_touched() const;
  // Writes time, positions, velocities and the hand with the collider it carries, and what was supplied. The caller checks the result
  // (divergence.h) before showing it.
  void end(const Plan& plan, State& state) const;

  // Indices in the System of springs that broke, in ascending order: the caller removes them.
  std::span<const Index> broken() const;

  // Of a method that adapts its step, for the coming frames: fewer than max_adaptive_evaluations.
  void limit_evaluations(long max) { substep_.limit_evaluations(max); }
  long force_evaluations() const { return motion_.force_evaluations; }
  long factorizations() const { return motion_.factorizations; }
  // The energy ledger of the frame, all cost counters, and the method's own error estimate.
  const Motion& motion() const { return motion_; }
  // [ms], of the frames that `auto` computed on copies so far and did not use, by the model of the cost.
  double trial_cost() const;
  // [ms], of what was computed of this frame, by the same model.
  double cost(const Plan& plan) const;

 private:
  void take_over(Frame& computed);
  bool begin_islands(const Plan& plan, const System& system, const Settings& settings, const State& state);

  AutomaticChoice automatic_;
  std::unique_ptr<IslandFrames> islands_;  // null: none so far
  bool is_divided_ = false;                // this frame is computed by them
  double start_ = 0.0, duration_ = 0.0;    // [s]
  int substeps_ = 0, substeps_done_ = 0;
  HandMotion hand_;
  Motion motion_;
  Substep substep_;
};

}  // namespace hooke
