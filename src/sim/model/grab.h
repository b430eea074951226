// Which hand acts in a frame, that of the user (the mouse) or the scripted hand of a scene, and where it is.
#pragma once

#include <optional>

#include "sim/model/state.h"

namespace hooke {

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

}  // namespace hooke
