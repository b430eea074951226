// Runs beside the run on screen, drawn as ghosts: the same scene from the same state and with the same input, computed with other
// settings. Each is at the time of the run: the next frame of the run waits for them.
#pragma once

#include <vector>

#include "lab/accuracy/companion.h"
#include "lab/accuracy/shadow_run.h"

namespace hooke {

class Companions {
 public:
  // They start with the next frame.
  void set(std::vector<Companion> companions);
  // They start again with the next frame, because the scene was edited.
  void restart();

  // A finished frame of the run; `plan` is that of `system`. Finishes the frame before, if it is not.
  void add_frame(const Plan& plan, const System& system, const Settings& settings, const State& before, const State& after);
  // Whether the last frame is not finished; then `substep` computes a substep of it.
  bool has_work() const { return has_frame_; }
  void substep(const System& system);

  const CompanionsStatus& status() const { return status_; }

 private:
  struct Run {
    ShadowRun shadow;
    bool is_on = false, is_done = false;  // is_done: with the frame
  };
  void start(const Plan& plan, const State& state);
  void finish_frame(const System& system);

  std::vector<Companion> companions_;
  std::vector<Run> runs_;
  bool is_new_ = true, has_frame_ = false;
  // the frame of the run that they follow
  double time_ = 0.0, end_time_ = 0.0, frame_rate_ = 60.0;  // [s], [s], [1/s]
  Hand hand_;
  std::vector<Vec3> end_;
  CompanionTable table_;
  CompanionsStatus status_;
};

}  // namespace hooke
