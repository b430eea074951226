// One frame of a scene, substep by substep.
#pragma once

#include <span>

#include "sim/forces/motion.h"
#include "sim/model/settings.h"
#include "sim/model/state.h"
#include "sim/step/substep.h"
#include "sim/step/supply.h"

namespace hooke {

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
  bool done() const { return substeps_done_ >= substeps_ || failure() != StepFailure::None; }
  // Why the frame ended early; its state is then one within the frame.
  StepFailure failure() const { return substep_.failure(); }
  const Integrator* method() const { return &substep_.method(); }
  int substeps_done() const { return substeps_done_; }
  double duration() const { return duration_; }  // [s]
  // Whether any point touched a collider or another point; and whether one struck something: it did not only rest, slide or leave.
  bool has_touched() const { return substep_.has_touched(); }
  bool has_impact() const { return substep_.has_impact(); }
  // Writes time, positions, velocities and the hand with the collider it carries, and what was supplied. The caller checks the result
  // (divergence.h) before showing it.
  void end(const Plan& plan, State& state) const;

  // Indices in the System of springs that broke, in ascending order: the caller removes them.
  std::span<const Index> broken() const { return substep_.broken(); }

  // Of a method that adapts its step, for the coming frames: fewer than max_adaptive_evaluations.
  void limit_evaluations(long max) { substep_.limit_evaluations(max); }
  long force_evaluations() const { return motion_.counts.force_evaluations; }
  long factorizations() const { return motion_.counts.factorizations; }
  // The energy ledger of the frame, all cost counters, and the method's own error estimate.
  const Motion& motion() const { return motion_; }

 private:
  double start_ = 0.0, duration_ = 0.0;  // [s]
  int substeps_ = 0, substeps_done_ = 0;
  HandMotion hand_;
  Motion motion_;
  Substep substep_;
};

}  // namespace hooke
