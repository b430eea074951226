// The warning about points that touch each other and overlap.
#pragma once

#include <optional>
#include <string>

#include "sim/state.h"
#include "sim/system.h"

namespace hooke {

// "contact.points: ...": how many pairs of points overlap by more than a thousandth of the distance at which they touch, and which of them
// most; none if none do, or points do not touch each other.
std::optional<std::string> overlap_warning(const System& system, const State& state);

}  // namespace hooke
