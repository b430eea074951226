// How fast springs turn and stretch: the error of a frame grows with it as soon as a cloth or a rope whips, before the mean speed rises.
#pragma once

#include "sim/model/state.h"
#include "sim/plan/plan.h"

namespace hooke {

// [1/s], the maximum of |w| / l over the springs, w the relative velocity of the ends and l the length: of all springs, or of as many,
// evenly spaced, as cost little relative to a frame of `frame_cost` [ms] by the model of the cost. 0 without springs.
double turning_of(const Plan& plan, const State& state, double frame_cost);

}  // namespace hooke
