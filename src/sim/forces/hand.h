// The force of the hand that acts in a frame, and its power.
#pragma once

#include "base/types.h"

namespace hooke {

struct Motion;
struct Plan;

// The force [N] of the hand: that of the spring of a pull, or the force that holds a held point against its springs and dashpots and,
// unless it is nailed, its weight. Zero without a grab.
Vec3 hand_force(const Plan& plan, const Motion& motion);
// The energy [J] of the springs between a held point and points that do not move: only the hand changes it.
double energy_of_hand_alone(const Plan& plan, const Motion& motion);
// The power [W] of the force of the hand, without what it does to those.
double hand_power(const Plan& plan, const Motion& motion);

}  // namespace hooke
