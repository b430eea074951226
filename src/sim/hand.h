// The hands: the person's at the screen and the one that a scene lists. Which of them acts, where it is and what force it exerts.
#pragma once

#include <optional>

#include "sim/state.h"

namespace hooke {

struct Motion;
struct Plan;

// Position of a scripted hand [m] at a time of the scene's clock, whether or not it holds its point then.
Vec3 position_at(const ScriptedHand& hand, double time);

// What the hand that acts holds during a frame, and where it is to be at the end of it.
struct ActiveGrab {
  PointId point{};
  GrabKind kind = GrabKind::Hold;
  Vec3 target{0.0};  // [m]
};

// The grab during the frame of `duration` [s] that begins at the State's time: the person's, or else the scripted hand's, from the
// first frame that begins when it takes hold to the one in which its seconds are over. Nothing when its point has been removed.
std::optional<ActiveGrab> active_grab(const System& system, const State& state, double duration);

// The force [N] that the hand exerts: the spring of a pull, or what holds a held point against its springs and dashpots and, unless
// it is nailed, its weight. Zero without a hand.
Vec3 hand_force(const Plan& plan, const Motion& motion);
// The power [W] of that force.
double hand_power(const Plan& plan, const Motion& motion);

}  // namespace hooke
