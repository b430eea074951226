// Kick h/2, drift h, kick h/2:  v = v E + a(x) phi,  x = x + h v,  v = v E + a(x) phi     (Stoermer-Verlet)
// with E = e^(-c h/2), phi = (1 - E) / c (h/2 when c = 0). Dashpots are split off: each is solved exactly, in a forward
// sweep of h/2 before and a backward sweep of h/2 after (dashpot.h). Second order, symplectic when undamped,
// stable for h omega < 2 whatever the dashpots.
//
// Listed forces that depend on velocity are evaluated at v for the first kick and at E v + phi a for the last one, which keeps the second
// order and costs a second evaluation of them per step.
#include "sim/forces/energy/plan_energy.h"
#include "sim/forces/forces.h"
#include "sim/forces/kick.h"
#include "sim/forces/leapfrog_pass.h"
#include "sim/methods/rows.h"

namespace hooke {
namespace {

void prepare(const Plan& plan, double h, const Motion& motion, Workspace& work) {
  work.size_fields(plan.force_data.depend_on_velocity ? 2 : 0, motion);
  if (plan.has_dashpots()) work.dashpots.prepare(plan, 0.5 * h);
}

// The forces that do not depend on velocity are those at the end of the step before.
void kick_and_drift_with_velocity(const Plan& plan, Motion& motion, Workspace& work, double h) {
  Field &unlisted = work.fields[0], &predicted = work.fields[1];
  const auto accelerate = [&](double time, const Field& v) {
    motion.a = unlisted;
    add_force_terms(plan, time, motion.x, v, motion.a);
    divide_by_mass(plan, motion.a);
    ++motion.counts.force_evaluations;
  };
  if (!motion.acceleration_is_current) compute_unlisted_forces(plan, motion.time, motion.x, nullptr, unlisted);
  accelerate(motion.time, motion.v);
  kick_and_drift(plan, motion, 0.5 * h, h, {.predicted = &predicted, .ahead = 0.5 * h});
  compute_unlisted_forces(plan, motion.time + h, motion.x, nullptr, unlisted);
  accelerate(motion.time + h, predicted);
  kick(plan, motion, 0.5 * h);
}

void step(const Plan& plan, Motion& motion, Workspace& work, double h) {
  const bool damped = plan.has_dashpots();
  if (damped) work.dashpots.sweep(plan, SweepDirection::Forward, motion.time, motion.x, motion.v);
  if (plan.force_data.depend_on_velocity) {
    kick_and_drift_with_velocity(plan, motion, work, h);
  } else {
    start_kick_and_drift(plan, motion, 0.5 * h, h);
    accelerate_kick_and_drift(plan, motion.time + h, motion, 0.5 * h, 0.0);
  }
  motion.acceleration_is_current = true;
  if (damped) work.dashpots.sweep(plan, SweepDirection::Backward, motion.time + h, motion.x, motion.v);
  motion.counts.dashpot_sweeps += damped ? 2 : 0;
}

// Without sweeps between them, the last kick of a step and the first of the next are one of h.
void steps(const Plan& plan, Motion& motion, Workspace& work, double h, int count) {
  if (plan.has_dashpots()) {
    for (int i = 0; i < count; ++i, motion.time += h) step(plan, motion, work, h);
    return;
  }
  start_kick_and_drift(plan, motion, 0.5 * h, h);
  motion.time += h;
  repeat_kick_and_drift(plan, motion, h, count - 1);
  accelerate_kick_and_drift(plan, motion.time, motion, 0.5 * h, 0.0);
  motion.acceleration_is_current = true;
}

// Drag and dashpots are left out: they do not conserve energy.
double modified_energy(const Plan& plan, const Motion& motion, double h) {
  return verlet_energy_difference(plan, motion.time, motion.x, motion.v, h);
}

// The columns of the step's matrix on (x, h v), with E and phi per half step.
Amplification amplification(const Oscillator& oscillator) {
  const auto [decay, phi] = kick_over(oscillator.h_drag, 0.5);
  const double dashpot = portable::exp(-0.5 * oscillator.h_lambda);
  double x[] = {1.0, 0.0}, v[] = {0.0, dashpot};
  for (int column = 0; column < 2; ++column) {
    const double start = -oscillator.h_omega_squared * x[column] - oscillator.h_rate * v[column];
    const double half = decay * v[column] + phi * start;
    x[column] += half;
    const double end = -oscillator.h_omega_squared * x[column] - oscillator.h_rate * (decay * half + phi * start);
    v[column] = decay * half + phi * end;
  }
  const double determinant = oscillator.h_rate == 0.0 ? dashpot * decay * dashpot * decay : dashpot * (x[0] * v[1] - x[1] * v[0]);
  return {.trace = x[0] + dashpot * v[1], .determinant = determinant};
}

}  // namespace

constinit const Integrator velocity_verlet{
    .id = "velocity_verlet",
    .label = "Velocity Verlet",
    .summary = "The standard choice: second order, no energy drift, one force evaluation per step, dashpots of any strength.",
    .cost = "one force evaluation per step; two sweeps over the dashpots; two evaluations of forces that depend on velocity",
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
    .order_with = {.drag = 2, .damped = 2, .contact = 2, .force_terms = 2},
    .stability = Stability::Conditional,
    .energy = EnergyTrend::Bounded,
    .splits_dashpots = true,
    .prepare = prepare,
    .step = step,
    .amplification = amplification,
    .modified_energy = modified_energy,
    .steps = steps,
};

}  // namespace hooke
