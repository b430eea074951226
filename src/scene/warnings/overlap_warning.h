// Warnings about contact of points with each other, of faces and of springs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

// "contact.faces: ...": how many edges pass through faces, springs of flat scenes cross each other and points overlap, and which of them;
// where none cross, how many features start far closer than their thickness, or in one place; what has no effect: faces of flat
// scenes; where springs pass through faces because only one of both touches; and springs between surfaces, which never do. Of what touches
// only. O(n log n).
std::vector<std::string> crossing_warnings(const System& system, const State& state);

// "contact.thickness: ...": that some faces or springs touch at another distance than the thickness; none if they do not.
std::optional<std::string> thickness_warning(const System& system);

}  // namespace hooke
