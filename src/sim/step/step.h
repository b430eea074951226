// One frame of a scene, substep by substep.
#pragma once

#include <span>

#include "sim/contact/contact.h"
#include "sim/forces/energy/force_work.h"
#include "sim/forces/terms/sticking.h"
#include "sim/methods/integrator.h"
#include "sim/model/settings.h"
#include "sim/model/state.h"
#include "sim/step/adaptive_step.h"

namespace hooke {

// Why a frame ended early: for an adaptive method no step is short enough for a finite error, or a frame takes more than
// max_adaptive_evaluations force evaluations or max_adaptive_surface_steps, those of rejected steps included; or more than
// PairSolver::max_pairs pairs of points come within reach of each other in one substep, or these hit each other, or surfaces move, so that
// the search for impacts does not end; or an implicit method needs a factor of more than max_factor_entries.
enum class StepFailure { None, TooShort, TooMany, TooManyPairs, MatrixTooLarge };

// A frame in progress. Reused from frame to frame, so that stepping does not allocate:
//   frame.begin(plan, system, settings, state); while (!frame.done()) frame.substep(plan); frame.end(plan, state);
// Between begin and end only the frame may change the plan: the k and d of springs that break become zero, until the plan is
// rebuilt or refreshed. The State is not changed.
class Frame {
 public:
  // Sets the motion of the hand and packs the state. The plan must be current, and the method have a step of its own: that of `auto` is
  // computed by a FrameRunner (control/frame_runner.h).
  void begin(Plan& plan, const System& system, const Settings& settings, const State& state);
  // One substep; where nothing acts between them several, as many in every run; or, of an adaptive method, one of its own steps, so that
  // the time that a call takes is bounded.
  void substep(Plan& plan);
  bool done() const { return substeps_done_ >= substeps_ || failure_ != StepFailure::None; }
  // Why the frame ended early; its state is then one within the frame.
  StepFailure failure() const { return failure_; }
  const Integrator* method() const { return integrator_; }  // null: no frame yet
  int substeps_done() const { return substeps_done_; }
  double duration() const { return duration_; }  // [s]
  // Whether any point touched a collider or another point.
  bool has_touched() const { return has_touched_; }
  // Whether a point struck something: it did not only rest, slide or leave.
  bool has_impact() const { return has_impact_; }
  // Writes time, positions, velocities and the hand with the collider it carries, and adds their work to the ledger. The caller checks the
  // result (divergence.h) before showing it.
  void end(const Plan& plan, State& state) const;

  // Indices in the System of springs that broke, in ascending order: the caller removes them.
  std::span<const Index> broken() const { return broken_; }

  // Of a method that adapts its step, for the coming frames: fewer than max_adaptive_evaluations.
  void limit_evaluations(long max) { adaptive_step_.limit_evaluations(max); }
  long force_evaluations() const { return motion_.counts.force_evaluations; }
  long factorizations() const { return motion_.counts.factorizations; }
  // All cost counters, and the method's own error estimate.
  const Motion& motion() const { return motion_; }

 private:
  bool take_several(const Plan& plan);
  double advance(Plan& plan, double length, bool& is_moved);
  double advance_to_release(Plan& plan, double length, bool& is_moved);
  bool act(Plan& plan, double h);
  void break_long_springs(Plan& plan);
  void prepare_method(const Plan& plan, double h);
  double next_step(const Plan& plan) const;

  const Integrator* integrator_ = nullptr;
  double start_ = 0.0, duration_ = 0.0, h_ = 0.0;  // [s]
  int substeps_ = 0, substeps_done_ = 0;
  double left_ = 0.0;  // [s], of the substep in progress
  bool locates_breaks_ = false;
  double prepared_ = 0.0;  // [s], the step for which the method is prepared
  StepFailure failure_ = StepFailure::None;
  bool has_touched_ = false, has_impact_ = false;
  Vec3 target_{0.0};
  double hand_stretch_ = 0.0;  // [J], of this frame (EnergyLedger)
  double hand_speed_ = 0.0;    // [m/s], of this frame
  Motion motion_;
  Workspace work_;
  ContactWorkspace before_;
  AdaptiveStep adaptive_step_;
  ForceWork force_work_;
  Sticking sticking_;
  std::vector<Index> broken_;
  Vec3 collider_displacement_{0.0};  // [m], of the carried collider in this frame
};

}  // namespace hooke
