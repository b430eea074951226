// Repeats one frame of a run with half the step: the error of that frame. And, where it is asked for, with a
// quarter of the step: the order with which the error falls.
#pragma once

#include <optional>

#include "lab/accuracy/shadow_run.h"
#include "sim/control/frame_error.h"

namespace hooke {

// RMS distances [m] between the ends of the frame with the step and half of it, and with half and a quarter of it.
struct FrameRefinement {
  double by_half = 0.0, by_quarter = 0.0;
};

class FrameRepetition {
 public:
  struct Result {
    FrameError error;
    double time = 0.0;                            // [s], at the end of the frame
    std::optional<FrameRefinement> refinement{};  // if it was asked for
  };

  // The frame that led from `before` to `after` by `evaluations` of the forces; `plan` is that of `system`.
  void begin(const Plan& plan, const System& system, const Settings& settings, const State& before, const State& after, long evaluations,
             bool measures_order);
  // Computes a substep; with the last one there is a result, unless the method found no step, or took too many.
  void substep(const System& system);
  bool is_in_progress() const { return run_.is_in_frame(); }
  // Abandons the repetition in progress and the result of the last one: the System is not the same any more.
  void reset();

  // Result of the last repetition; empty before the first one after `reset`, and if the last one failed.
  const std::optional<Result>& result() const { return result_; }
  bool has_failed() const { return has_failed_; }

 private:
  ShadowRun run_;
  std::vector<Vec3> end_;
  double weight_ = 1.0, time_ = 0.0;
  std::optional<Result> result_;
  bool has_failed_ = false;
  std::optional<State> before_;  // of a frame that is to be repeated with a quarter of the step, too
  Settings quarter_;
  std::optional<double> by_half_;  // [m], while it is
};

}  // namespace hooke
