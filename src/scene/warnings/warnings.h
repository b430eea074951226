// Warnings about a scene as it starts: what does not act, what contradicts itself, what touches or is too long at once. Each names the
// field of the scene file that it is about, the first item concerned and how many there are; none if there is nothing to warn of.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

// "forces: bending: ...": that it acts on no face, or on some only. "forces: pressure: ...": that it fills no closed surface, or not all.
std::optional<std::string> bending_warning(const System& system);
std::optional<std::string> pressure_warning(const System& system);

// "rest_angles[5]: ...": that the two faces of an edge have different rest angles across it. O(n log n).
std::optional<std::string> rest_angle_warning(const System& system);

// "contact.faces: ...": how many edges pass through faces, springs of flat scenes cross each other and points overlap, and which of them;
// where none cross, how many features start far closer than their thickness, or in one place; what has no effect: faces of flat
// scenes; where springs pass through faces because only one of both touches; and springs between surfaces, which never do. Of what touches
// only. O(n log n).
std::vector<std::string> crossing_warnings(const System& system, const State& state);

// "contact.thickness: ...": that some faces or springs touch at another distance than the thickness.
std::optional<std::string> thickness_warning(const System& system);

// "a ball of radius 0.1 m fits between the points of ...": only points touch colliders. None for planes, which nothing passes. O(n).
std::optional<std::string> small_collider_text(const System& system, const State& state, const Collider& collider);
// "colliders[0]: ...", of the first such collider.
std::optional<std::string> small_collider_warning(const System& system, const State& state);

// "strain_limit_percent: ...": springs with an end that can move are too long. What the limit itself leaves at the end of a run does not
// count.
std::optional<std::string> strain_limit_warning(const System& system, const State& state);

}  // namespace hooke
