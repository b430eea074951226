// Warnings about bending that does not act, and about rest angles that contradict each other.
#pragma once

#include <optional>
#include <string>

#include "sim/model/system.h"

namespace hooke {

// "forces: bending: ...": that it acts on no face, or on some only; none if it acts on all, or is off.
std::optional<std::string> bending_warning(const System& system);

// "rest_angles[5]: ...": that the two faces of an edge have different rest angles across it, the first of them and how many there are;
// none if there is none. O(n log n).
std::optional<std::string> rest_angle_warning(const System& system);

}  // namespace hooke
