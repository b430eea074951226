// The forces of a scene, in the layout of the Plan. Deterministic: the order of every sum is fixed by the Plan and independent of the width
// of the vector units. Nested sets, because methods split them differently.
#pragma once

#include "sim/forces/motion.h"

namespace hooke {

// f [N] of gravity, springs, the hand's pull and the listed forces: everything but dashpots and drag. The constant part of drag,
// drag * wind, is included. Only listed forces depend on the velocities.
void compute_position_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// f [N] of gravity, drag * wind, springs, their dashpots at the velocities v unless it is null, and the hand's pull: everything but drag
// and the listed forces.
void compute_unlisted_forces(const Plan& plan, double time, const Field& x, const Field* v, Field& f);

// f [N] of gravity, drag * wind and the listed forces: external to the network, for methods that treat springs and the hand's
// pull as constraints.
void compute_external_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f);
// The same, and returns the power [W] of add_force_terms_with_power.
double compute_external_forces_with_power(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// Whether anything but gravity and the springs of grids acts.
bool has_forces_outside_grids(const Plan& plan);
// Adds the hand's pull.
void add_pull(const Plan& plan, double time, const Field& x, Field& f);

// Adds the listed forces (force_term.h) only.
void add_force_terms(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// The same, and returns their power [W] but for that of forces derived from potentials.
double add_force_terms_with_power(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// f(t, x, v) [N], all forces, with dashpots and drag (-drag m v).
void compute_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// a(t, x, v) = M^-1 f(t, x, v), in one pass over the springs of grids; zero for nailed and held points.
void compute_accelerations(const Plan& plan, double time, const Field& x, const Field& v, Field& a);

// a = M^-1 f in place; zero for nailed and held points.
void divide_by_mass(const Plan& plan, Field& f);

}  // namespace hooke
