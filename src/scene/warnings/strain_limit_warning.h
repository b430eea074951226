// A warning about springs that start longer than the strain limit allows.
#pragma once

#include <optional>
#include <string>

#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

// "strain_limit_percent: ...": how many springs with an end that can move are too long, and which of them is the first; none if none is.
// What the limit itself leaves at the end of a run does not count.
std::optional<std::string> strain_limit_warning(const System& system, const State& state);

}  // namespace hooke
