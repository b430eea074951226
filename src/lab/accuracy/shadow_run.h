// A run computed beside another one, with a state of its own and the same input: with half the step, or from a start that differs
// slightly.
#pragma once

#include <algorithm>

#include "sim/control/frame_runner.h"

namespace hooke {

class ShadowRun {
 public:
  // Copies the plan, which must be that of the System that the frames are given until the next call. Computes in double precision, so that
  // the difference from a run in single precision includes its rounding.
  void set_plan(const Plan& plan) {
    plan_ = plan;
    plan_.execution.single.reset();
    plan_.execution.phases = nullptr;
  }
  const Plan& plan() const { return plan_; }
  void start(const State& state) { state_ = state, is_in_frame_ = false; }
  void stop() { is_in_frame_ = false; }

  // The coming frames fail if they take more force evaluations than this. With contact, a method that adapts its step may take any number
  // of times as many for a smaller tolerance. `evaluations`: of the frame that they are compared with.
  void limit_cost(long evaluations) {
    constexpr long min = 5'000, factor = 20;
    frame_.limit_evaluations(std::clamp(factor * evaluations, min, max_adaptive_evaluations));
  }

  // A frame from its own state, with the clock and the hand of the run that it follows.
  void begin_frame(const System& system, const Settings& settings, double time, const Hand& hand);
  void substep();
  // Whether the last frame ended early, and its state is one within the frame.
  bool failed() const { return frame_.failure() != StepFailure::None; }
  bool is_in_frame() const { return is_in_frame_; }

  // After the last finished frame.
  const State& state() const { return state_; }

 private:
  Plan plan_;
  FrameRunner frame_;
  State state_;
  bool is_in_frame_ = false;
};

}  // namespace hooke
