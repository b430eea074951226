// The hand of the user (the mouse) and the scripted hand of a scene: which of them acts, its position and its force.
#pragma once

#include <optional>

#include "sim/state.h"

namespace hooke {

struct Motion;
struct Plan;

// Position of a scripted hand [m] at a time of the scene's clock, whether or not it holds its point then.
Vec3 position_at(const ScriptedHand& hand, double time);

// What the active hand holds during a frame, and its target at the end of the frame.
struct ActiveGrab {
  PointId point{};
  GrabKind kind = GrabKind::Hold;
  Vec3 target{0.0};  // [m]
};

// The grab during the frame of `duration` [s] that begins at the time of the State: that of the user or else of the scripted hand, whose
// grab lasts from the first frame that starts at or after `begin` to the frame in which `seconds` have passed. Nothing if its point has
// been removed.
std::optional<ActiveGrab> active_grab(const System& system, const State& state, double duration);

// The force [N] of the hand: that of the spring of a pull, or the force that holds a held point against its springs and dashpots and,
// unless it is nailed, its weight. Zero without a grab.
Vec3 hand_force(const Plan& plan, const Motion& motion);
// The energy [J] of the springs between a held point and points that do not move: only the hand changes it.
double energy_of_hand_alone(const Plan& plan, const Motion& motion);
// The power [W] of the force of the hand, without what it does to those.
double hand_power(const Plan& plan, const Motion& motion);

}  // namespace hooke
