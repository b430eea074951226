// Runs with the method `auto`, frame by frame.
#pragma once

#include "sim/automatic/automatic.h"
#include "sim/step.h"
#include "support/nets.h"

namespace hooke {

inline Settings automatic(double tolerance, double budget_ms = 0.0) {
  return {.integrator = &automatic_method(), .tolerance = tolerance, .budget_ms = budget_ms};
}

inline State next_frame(Plan& plan, Frame& frame, const System& system, const Settings& settings, const State& state) {
  State next = state;
  refresh_values(plan, system);
  frame.begin(plan, system, settings, state);
  while (!frame.done()) frame.substep(plan);
  frame.end(plan, next);
  return next;
}

}  // namespace hooke
