// The work of stepping a copy of a scene, from counts: the same on every machine. A limit on it limits the time of a search.
#pragma once

#include "sim/control/frame_runner.h"

namespace hooke {

// [ns], what frames take at least by this model: their work beside that of the substeps.
double work_beside_substeps(double points, double springs, double frames);

class TrialWork {
 public:
  // Of the coming frames; they may still change the plan.
  explicit TrialWork(const Plan& plan) : plan_(plan) {}
  // [ns], approximately, of what was computed since the last call: of the frame in progress or, at its end, of the rest of it. To be called
  // after every substep, and with `is_finished` after the frame.
  double since_last(const FrameRunner& frame, bool is_finished);

 private:
  const Plan& plan_;
  double counted_ = 0.0, trials_ = 0.0;  // [ns], of this frame; of the trials of `auto`, in all frames
  long calls_ = 0;                       // in this frame
};

}  // namespace hooke
