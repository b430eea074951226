// The message about a run that stopped.
#pragma once

#include <string>

#include "sim/step/divergence.h"

namespace hooke {

// When it stopped, why, and at which point and spring (by their numbers in the lists, from 0): one sentence. What to do
// is a second one (study/remedy).
std::string describe(const Divergence& divergence, const System& system);

}  // namespace hooke
