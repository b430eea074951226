// Edits with their values, for the message about a run that stopped.
#pragma once

#include <string>

#include "edit/command.h"
#include "edit/history.h"
#include "lab/status.h"

namespace hooke {

// Whether a command affects the motion and is an edit, not the laboratory's own: only these can make a run diverge.
bool can_cause_failure(const Command& command);

// What a command sets, as it is now: "185", "Velocity Verlet". Empty for commands that set no single value.
std::string value_before(const Command& command, const Scene& scene);

// "k: 185 -> 270,000 N/m", with the value after the command; the name of the command if it sets no single value.
std::string change_text(const Command& command, const std::string& before, const Scene& scene);

}  // namespace hooke
