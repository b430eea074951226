// Runs with the method `auto`, frame by frame.
#pragma once

#include "sim/control/automatic.h"
#include "support/nets.h"
#include "support/next_frame.h"

namespace hooke {

inline Settings automatic(double tolerance, double budget_ms = 0.0) {
  return {.integrator = &automatic_method(), .tolerance = tolerance, .budget_ms = budget_ms};
}

}  // namespace hooke
