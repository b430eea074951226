// The dashpots of all springs alone, each solved exactly over a duration: the relative speed w along the spring decays
// as w exp(-d duration (1/mi + 1/mj)), an impulse along the spring. A forward sweep over the springs for h/2 before and
// a backward sweep for h/2 after a step of the rest is second order (Strang; Shardlow 2003 for the pairwise splitting),
// conserves momentum and is stable for any d. The same bits on every machine.
#pragma once

#include "sim/forces/constants.h"
#include "sim/plan/plan.h"

namespace hooke {

// One spring after another in the order of the runs, or in exactly the reverse order.
enum class SweepDirection { Forward, Backward };

// Changes v by the dashpots of all springs. `decay` comes from plan_dashpot_decay. Springs between coincident points do nothing.
void decay_dashpots(const Plan& plan, const std::vector<double>& decay, SweepDirection sweep, const Field& x, Field& v);

// The impulse per relative speed of each packed spring over `duration` [s]:
// (1 - exp(-d duration (1/mi + 1/mj))) / (1/mi + 1/mj) [kg]; 0 between two nails. Some more at the end, which
// vectors that are not full read.
void plan_dashpot_decay(const Plan& plan, double duration, std::vector<double>& decay);

}  // namespace hooke
