// Which hand acts, and where a listed one is.
#pragma once

#include <optional>

#include "sim/system.h"

namespace hooke {

// Where the hand is at a time of the scene's clock, whether or not it holds then [m].
Vec3 place_at(const ScriptedHand& hand, double time);

// The grab during the frame of `duration` [s] that begins at `time`: the person's, or else the listed hand's, from the first
// frame that begins when it takes hold to the one in which its seconds are over. Its point must still be there.
std::optional<Grab> acting_grab(const System& system, double time, double duration);

}  // namespace hooke
