// Which hand acts, where a listed one is, and what it does.
#pragma once

#include <optional>

#include "sim/system.h"

namespace hooke {

struct Motion;
struct Plan;

// Where the hand is at a time of the scene's clock, whether or not it holds then [m].
Vec3 position_at(const ScriptedHand& hand, double time);

// The grab during the frame of `duration` [s] that begins at `time`: the person's, or else the listed hand's, from the first
// frame that begins when it takes hold to the one in which its seconds are over. Its point must still be there.
std::optional<Grab> active_grab(const System& system, double time, double duration);

// The force [N] that the hand exerts: a pull's spring, or what holds a held point against its springs and dashpots and, unless
// it is a nail, its weight. Zero without a hand.
Vec3 hand_force(const Plan& plan, const Motion& motion);
// That times its velocity [W]: what it puts into the scene.
double hand_power(const Plan& plan, const Motion& motion);

}  // namespace hooke
