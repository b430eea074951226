// Two runs beside a run: one with half the step, whose distance from it shows the accumulated error, and one from a slightly different
// start, whose distance shows the growth of small differences. Frames wait in a queue until both have computed theirs; if too many
// wait, the runs end there and start again later.
#pragma once

#include <deque>
#include <optional>

#include "lab/accuracy/growth.h"
#include "lab/accuracy/shadow_run.h"
#include "sim/control/frame_error.h"

namespace hooke {

// A frame of the run, for the second runs.
struct SecondRunInput {
  double time = 0.0;  // [s], at the start of the frame
  Hand hand;
  Settings settings;
  std::vector<Vec3> end;  // positions after it
  double end_time = 0.0;  // [s]
  long evaluations = 0;   // of the forces
};

// A run beside the run.
struct SecondRun {
  ShadowRun shadow;
  bool is_on = false;
  long next = 0;  // number of the frame that it computes or waits for
};

// Measures the distance to the perturbed run.
struct GrowthRun {
  GrowthMeasurement measurement;
  std::optional<Growth> result;
  int pause = 0, frames = 0;  // until the next measurement, and of the current one
};

class SecondRuns {
 public:
  struct Error {
    double rms = 0.0;   // [m], over the points
    double time = 0.0;  // [s]
  };

  // Both start again with the next frame. `size` [m] is the scene's.
  void restart(double size);
  // The plan or the System differs from that of the frames before. If no frames are waiting, the run with half the step continues.
  void note_edit();
  void add_frame(const Plan& plan, const System& system, const Settings& settings, const State& before, const State& after,
                 long evaluations);

  // Whether frames wait; then `substep` computes a substep of one.
  bool has_work() const { return waits(refined_) || waits(perturbed_); }
  void substep(const System& system);

  double since() const { return since_; }                       // [s], start of the run with half the step
  const std::optional<Error>& error() const { return error_; }  // none before its first frame
  const std::optional<Error>& max_error() const { return max_error_; }
  const std::optional<Growth>& growth() const { return growth_.result; }  // none before the first measurement
  // The run with half the step. Failed: found no step, or took too many.
  bool diverged() const { return diverged_; }
  bool failed() const { return failed_; }
  // Whether that run resolves every vibration, with steps that may be far shorter than half (frame_error.h).
  bool is_resolving() const { return repetition_.is_resolving; }

 private:
  bool waits(const SecondRun& run) const { return run.is_on && run.next < first_ + static_cast<long>(inputs_.size()); }
  const SecondRunInput& input_of(const SecondRun& run) const { return inputs_[static_cast<std::size_t>(run.next - first_)]; }
  void start(SecondRun& run, const Plan& plan, const State& state);
  void perturb(const System& system, const State& state, double frame);
  void finish_frame(const System& system, SecondRun& run);

  double size_ = 1.0, since_ = 0.0;
  Repetition repetition_;  // of the last frame that the run with half the step began
  bool is_new_ = true, is_edited_ = false, diverged_ = false, failed_ = false;
  bool is_full_ = false;  // no more frames are taken until those that wait are computed, then it starts again
  SecondRun refined_, perturbed_;
  std::deque<SecondRunInput> inputs_;
  long first_ = 0;  // number of the first of them
  std::optional<Error> error_, max_error_;
  GrowthRun growth_;
};

}  // namespace hooke
