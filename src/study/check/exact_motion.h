// Solutions of a scene that need no small steps, as companions of its run: exact ones where they are known, and otherwise a reference.
#pragma once

#include <memory>
#include <optional>

#include "lab/accuracy/companions.h"

namespace hooke {

// A formula for the motion, none if there is none:
//   - springs and motion along one line, where no spring starts with the energy to pass through zero length:
//     x'' = M^-1 (f - K x - D x') exactly, by the exponential of its matrix;
//   - a rope of equal parts between two nails: the elastic catenary in which it comes to rest;
//   - small vibrations about an equilibrium, such as those of a pendulum, without rigid rotations: the same equation, linearized there,
//     which is exact to first order in the amplitude.
// The hand, listed forces and limits exclude them, and so do more than LinearMotion::max_unknowns coordinates, except for a catenary.
// Contact is ignored, and the name says so.
std::optional<Companion> exact_companion(const std::shared_ptr<const System>& system, const State& state);

// With the settings of a run, named after them: "Velocity Verlet, 80 substeps".
Companion companion_of(const Settings& settings);

// The formula, or Dormand-Prince 8 with a tolerance of 1e-9 of the size of the scene.
Companion exact_or_reference(const std::shared_ptr<const System>& system, const State& state, const Settings& settings);

}  // namespace hooke
