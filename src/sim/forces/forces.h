// The forces of a scene, in the Plan's layout. Deterministic: the order of every sum is fixed by the Plan, whatever the
// width of the vector units. Three nested sets, because methods split them differently.
#pragma once

#include "sim/motion.h"

namespace hooke {

// f [N] of gravity, springs, the hand's pull and the scene's listed forces: all but dashpots and drag. A wind's share of
// drag (drag * wind, a constant acceleration) counts here too. Only listed forces look at the velocities.
void compute_position_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// f [N] of gravity, wind's share of drag and the listed forces: what comes from outside the network, for methods that
// treat springs and the hand's pull as constraints.
void compute_external_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// f [N] of gravity, wind's share of drag, springs with their dashpots and the hand's pull: all but drag and the listed
// forces.
void compute_network_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// Adds the forces of the scene's list (force_term.h) alone.
void add_force_terms(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// The listed forces and those of the network: all but drag, for methods that integrate drag exactly.
void compute_explicit_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// f(t, x, v) [N] of everything: the above and drag (-drag m v).
void compute_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// a = M^-1 f in place; zero for nailed and held points.
void divide_by_mass(const Plan& plan, Field& f);

}  // namespace hooke
