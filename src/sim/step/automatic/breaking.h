// Springs that break are events for `auto`: each breaks at the end of a substep, up to a substep too late, whatever the order of the
// method.
#pragma once

#include <span>

#include "sim/model/state.h"
#include "sim/plan/plan.h"

namespace hooke {

// Whether a spring would reach the length at which it breaks within `duration` [s], at the velocities of this state.
bool is_about_to_break(const Plan& plan, const State& state, double duration);

// The error of the positions at the end of a frame of `duration` [s] [m], RMS over the points, if each of these springs of the System
// broke half a `step` [s] too late: the impulse of its force in that time moves its ends, and, by waves, their neighbors.
double breaking_error(const Plan& plan, const System& system, std::span<const Index> broken, double duration, double step);

}  // namespace hooke
