// The only writer of System, State and Settings outside the step.
#pragma once

#include <vector>

#include "edit/command.h"

namespace hooke {

// What an edit made stale.
struct Effect {
  bool structure = false;  // points or springs came or went: the Plan must be made anew
  bool values = false;     // the Plan's values must be refreshed
};

// Applies `command` to the scene and returns the commands that undo exactly what it changed, to be applied in order.
// Parts that name things that are gone do nothing. Never touches time (save Replace) or other points' motion.
std::vector<Command> apply(Scene& scene, const Command& command, Effect& effect);

}  // namespace hooke
