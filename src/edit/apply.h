// The only writer of System, State and Settings outside the step.
#pragma once

#include "edit/command.h"

namespace hooke {

// Applies `command` to the scene, increments its revision unless only the State changed, and returns the commands that undo exactly
// what it changed, to be applied in order. Parts that name removed things do nothing. Never changes the time (except GoToState and
// Replace) or the motion of other points.
Inverse apply(Scene& scene, const Command& command, Effect& effect);

}  // namespace hooke
