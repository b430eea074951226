// Warnings about contact of points with each other, of faces and of springs.
#pragma once

#include <optional>
#include <string>

#include "sim/state.h"
#include "sim/system.h"

namespace hooke {

// "contact.points: ...": how many pairs of points overlap by more than a thousandth of the distance at which they touch, and which of them
// most; none if none do, or points do not touch each other.
std::optional<std::string> overlap_warning(const System& system, const State& state);

// "contact.faces: ...": how many edges pass through faces, and which one; or that there are no faces that could touch. None if none do, or
// faces do not touch.
std::optional<std::string> crossing_warning(const System& system, const State& state);

// "contact: ...": how many free points are on no spring or face, and pass through those that touch each other; none if there are none.
std::optional<std::string> loose_point_warning(const System& system);

// "contact.thickness: ...": that some faces or springs touch at another distance than the thickness; none if they do not.
std::optional<std::string> thickness_warning(const System& system);

}  // namespace hooke
