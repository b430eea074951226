// Kick h/2, drift h, kick h/2:  v = v E + a(x) phi,  x = x + h v,  v = v E + a(x) phi     (Stoermer-Verlet)
// with E = e^(-c h/2), phi = (1 - E) / c (h/2 when c = 0). Dashpots are split off: each is solved exactly, in a forward
// sweep of h/2 before and a backward sweep of h/2 after (dashpot.h). Second order, symplectic when undamped,
// stable for h omega < 2 whatever the dashpots.
#include <cmath>

#include "sim/forces/dashpot.h"
#include "sim/forces/forces.h"
#include "sim/integrators/rows.h"

namespace hooke {
namespace {

void prepare(const Plan& plan, double h, const Motion& motion, Workspace& work) {
  work.size_fields(1, motion);
  if (plan.has_dashpots()) plan_dashpot_decay(plan, 0.5 * h, work.fields[0]);
}

void step(const Plan& plan, Motion& motion, Workspace& work, double h) {
  if (plan.has_dashpots()) decay_dashpots(plan, work.fields[0], Sweep::Forward, motion.x, motion.v);
  if (!motion.acceleration_is_current) {
    compute_position_forces(plan, motion.time, motion.x, motion.v, motion.a);
    divide_by_mass(plan, motion.a);
    ++motion.force_evaluations;
  }

  kick(plan, motion, 0.5 * h);
  drift(motion, h);

  compute_position_forces(plan, motion.time + h, motion.x, motion.v, motion.a);
  divide_by_mass(plan, motion.a);
  ++motion.force_evaluations;
  kick(plan, motion, 0.5 * h);
  motion.acceleration_is_current = true;

  if (plan.has_dashpots()) decay_dashpots(plan, work.fields[0], Sweep::Backward, motion.x, motion.v);
}

// D V D, D = diag(1, e^(-h lambda / 2)) and V the kick-drift-kick matrix, with E and phi per step of h/2
Amplification amplification(const Oscillator& oscillator) {
  const double decay = std::exp(-0.5 * oscillator.h_drag);
  const double phi = oscillator.h_drag == 0.0 ? 0.5 : -std::expm1(-0.5 * oscillator.h_drag) / oscillator.h_drag;
  const double kick = phi * oscillator.h_omega_squared;
  const double dashpot = std::exp(-oscillator.h_lambda);
  return {.trace = 1.0 - kick + dashpot * decay * (decay - kick), .determinant = dashpot * decay * decay};
}

}  // namespace

constinit const Integrator velocity_verlet{
    .id = "velocity_verlet",
    .label = "Velocity Verlet",
    .summary = "The workhorse: second order, no energy drift, one force evaluation a step, exact dashpots.",
    .cost = "one force evaluation a step; two sweeps over the dashpots",
    .formula =
        "dashpots over h/2, each exactly, forward\n"
        "v = E v + phi a(x),   E = e^(-c h/2), phi = (1 - E) / c\n"
        "x' = x + h v\n"
        "v' = E v + phi a(x')\n"
        "dashpots over h/2, backward",
    .source =
        "C. Stoermer, 1907; L. Verlet, Phys. Rev. 159 (1967) 98-103; W. C. Swope et al., J. Chem. Phys. 76 (1982) 637-649; splitting: G. "
        "Strang, 1968",
    .order = 2,
    .order_drag = 2,
    .order_damped = 2,
    .order_contact = 2,
    .stability = Stability::Conditional,
    .energy = EnergyTrend::Bounded,
    .symplectic = true,
    .for_production = true,
    .prepare = prepare,
    .step = step,
    .amplification = amplification,
};

}  // namespace hooke
