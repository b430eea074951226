// One frame of a scene.
#pragma once

#include "sim/control/frame_runner.h"

namespace hooke {

// The state after the frame. `plan` is that of the system; its values are refreshed, which restores springs that broke.
template <class Stepper>
State next_frame(Plan& plan, Stepper& frame, const System& system, const Settings& settings, const State& state) {
  State next = state;
  refresh_values(plan, system);
  frame.begin(plan, system, settings, state);
  while (!frame.done()) frame.substep(plan);
  frame.end(plan, next);
  return next;
}

}  // namespace hooke
