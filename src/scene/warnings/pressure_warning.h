// A warning about gas that fills nothing.
#pragma once

#include <optional>
#include <string>

#include "sim/model/system.h"

namespace hooke {

// "forces: pressure: ...": that it fills no closed surface, or not all surfaces of the scene; none if it does, or is off.
std::optional<std::string> pressure_warning(const System& system);

}  // namespace hooke
