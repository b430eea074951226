// The forces of a scene, in the layout of the Plan. Deterministic: the order of every sum is fixed by the Plan and independent of the width
// of the vector units. Nested sets, because methods split them differently.
#pragma once

#include "sim/forces/motion.h"

namespace hooke {

// f [N] of gravity, springs, the hand's pull and the listed forces: everything but dashpots and drag. The constant part of drag,
// drag * wind, is included. Only listed forces depend on the velocities.
void compute_position_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// The same without the listed forces, which alone may depend on the velocities.
void compute_unlisted_forces(const Plan& plan, double time, const Field& x, Field& f);

// Adds the forces of springs, of their dashpots at the velocities v unless it is null, and of the hand's pull.
void add_inner_forces(const Plan& plan, double time, const Field& x, const Field* v, Field& f);

// f [N] of gravity, drag * wind and the listed forces: external to the network, for methods that treat springs and the hand's
// pull as constraints.
void compute_external_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// f [N] of gravity, drag * wind, springs with their dashpots and the hand's pull: everything but drag and the listed
// forces.
void compute_network_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// Adds the listed forces (force_term.h) only.
void add_force_terms(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// The same, and returns their power [W] but for that of forces derived from potentials.
double add_force_terms_with_power(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// The network forces and the listed ones: everything but drag, for methods that integrate drag exactly.
void compute_explicit_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// f(t, x, v) [N], all forces: the above and drag (-drag m v).
void compute_forces(const Plan& plan, double time, const Field& x, const Field& v, Field& f);

// a(t, x, v) = M^-1 f(t, x, v), to the same bits as one after the other.
void compute_accelerations(const Plan& plan, double time, const Field& x, const Field& v, Field& a);

// a = M^-1 f in place; zero for nailed and held points.
void divide_by_mass(const Plan& plan, Field& f);

}  // namespace hooke
