// Energies of a Motion, in the layout of the Plan.
#pragma once

#include "sim/forces/motion.h"

namespace hooke {

// [J], of springs and gravity, at this time and the positions x.
double stored_energy(const Plan& plan, double time, const Field& x);
// [J], of the free points.
double kinetic_energy(const Plan& plan, const Field& v);
// [J], of springs, gravity and the potentials of the listed forces at this time; and the same with the kinetic energy.
double potential_energy(const Plan& plan, double time, const Field& x);
double mechanical_energy(const Plan& plan, double time, const Motion& motion);
// [W], that the dashpots dissipate.
double dashpot_power(const Plan& plan, double time, const Field& x, const Field& v);

// [J], of moving air on the way from `start` to `end`: through drag it accelerates all points alike, so that this is exact for any path.
double air_work(const Plan& plan, const Field& start, const Field& end);

// [J], the term of order h^2 by which the modified energy of velocity Verlet exceeds the energy, at the positions x and velocities v, for
// forces that depend on positions alone:
//   h^2 (v.V'' v / 12 - V'.M^-1 V' / 24)     (E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, IX.3)
// with V'' v from the forces at x + h v and x - h v.
double verlet_energy_difference(const Plan& plan, double time, const Field& x, const Field& v, double h);

// [J], bound on what drag and dashpots dissipate within a frame of `duration` [s], in a scene that was supplied with `supplied` [J] and
// whose kinetic energy is at most `kinetic` [J] at the ends of the frame: within it, it is taken to be at most twice that, or `supplied`.
double max_dissipation(const Spectrum& spectrum, double supplied, double kinetic, double duration);

}  // namespace hooke
