// The only writer of System, State and Settings outside the step.
#pragma once

#include <vector>

#include "edit/command.h"

namespace hooke {

// What an edit makes stale.
struct Effect {
  bool structure = false;  // points or springs were added or removed: the Plan must be rebuilt
  bool values = false;     // the Plan's values must be refreshed
  bool motion = false;     // positions or velocities changed

  // Whether a frame that was begun before the edit must be computed again. An edit of a setting takes effect with the next frame.
  bool invalidates_frame() const { return structure || values || motion; }
};

// Applies `command` to the scene, increments its revision unless only the State changed, and returns the commands that undo exactly
// what it changed, to be applied in order. Parts that name removed things do nothing. Never changes the time (except GoToState and
// Replace) or the motion of other points.
std::vector<Command> apply(Scene& scene, const Command& command, Effect& effect);

}  // namespace hooke
