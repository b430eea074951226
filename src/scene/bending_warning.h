// A warning about bending that does not act.
#pragma once

#include <optional>
#include <string>

#include "sim/system.h"

namespace hooke {

// "forces: bending: ...": that it acts on no face, or on some only; none if it acts on all, or is off.
std::optional<std::string> bending_warning(const System& system);

}  // namespace hooke
