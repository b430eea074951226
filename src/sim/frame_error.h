// Error estimate of a frame, by repeating it with half the step.
#pragma once

#include "sim/settings.h"
#include "sim/state.h"
#include "sim/system.h"

namespace hooke {

// The error [m], RMS over the points, that the method of `settings` makes in the one frame that follows `state`:
// |x_h - x_(h/2)| 2^p / (2^p - 1) for a method of order p (Richardson); an adaptive method's own estimate. Costs three
// frames, and allocates.
double estimate_frame_error(const System& system, const Settings& settings, const State& state);

}  // namespace hooke
