// A warning about colliders that fit between the points of what they should stop.
#pragma once

#include <optional>
#include <string>

#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

// "a ball of radius 0.1 m fits between the points of ...": only points touch colliders. None for planes, which nothing passes. O(n).
std::optional<std::string> small_collider_text(const System& system, const State& state, const Collider& collider);

// "colliders[0]: ...", of the first such collider.
std::optional<std::string> small_collider_warning(const System& system, const State& state);

}  // namespace hooke
