// Whether a scene fits into the plane z = 0 of flat scenes.
#pragma once

#include <string>

#include "sim/model/state.h"

namespace hooke {

// The first thing that a file of a flat scene must not contain: "point 5 is not at z = 0"; empty if there is none.
std::string why_not_in_plane(const System& system, const State& state);

// The first thing that does not lie in the plane, colliders and forces included, which a file may contain: "point 5 is not at z = 0"; empty
// if everything does.
std::string why_not_flat(const System& system, const State& state);

}  // namespace hooke
