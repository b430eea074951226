// v' = v e^(-c h) + a(x, v) (1 - e^(-c h)) / c,  x' = x + h v'     (a without drag; h instead of the fraction if c = 0)
// First order, symplectic, stable for h omega < 2. Also called semi-implicit or modified Euler. The factor makes the
// velocity of a fall with drag exact for any h; it must multiply the whole acceleration, or equilibria shift.
#include "sim/forces/energy/plan_energy.h"
#include "sim/forces/forces.h"
#include "sim/forces/kick.h"
#include "sim/forces/leapfrog_pass.h"
#include "sim/methods/rows.h"

namespace hooke {
namespace {

void step(const Plan& plan, Motion& motion, Workspace&, double h) {
  accelerate_kick_and_drift(plan, motion.time, motion, h, h, {.acting = &motion.v});
  motion.power.reset();  // at the start of the step
}

// Its velocity is that of velocity Verlet half a step earlier, a kick of h/2 behind the position: with that kick the energy is that of
// velocity Verlet.
double modified_energy(const Plan& plan, const Motion& motion, double h) {
  Field v(motion.x.size());
  compute_position_forces(plan, motion.time, motion.x, motion.v, v);
  double kinetic = 0.0;
  for (std::size_t at = 0; at < v.size(); ++at) {
    const std::size_t i = at % static_cast<std::size_t>(plan.points);
    const double force = v[at];
    v[at] = motion.v[at];
    if (plan.inverse_mass[i] == 0.0) continue;
    v[at] += 0.5 * h * plan.inverse_mass[i] * force;
    kinetic += 0.5 * plan.mass[i] * (v[at] * v[at] - motion.v[at] * motion.v[at]);
  }
  return kinetic + verlet_energy_difference(plan, motion.time, motion.x, v, h);
}

void steps(const Plan& plan, Motion& motion, Workspace&, double h, int count) {
  repeat_kick_and_drift(plan, motion, h, count, {.acting = &motion.v});
}

// v' = E v - phi h (omega^2 x + (lambda + q) v), x' = x + h v', with E = e^(-h c), phi = (1 - E) / (h c)
Amplification amplification(const Oscillator& oscillator) {
  const auto [decay, phi] = kick_over(oscillator.h_drag, 1.0);
  const double determinant = decay - phi * (oscillator.h_lambda + oscillator.h_rate);
  return {.trace = 1.0 + determinant - phi * oscillator.h_omega_squared, .determinant = determinant};
}

}  // namespace

constinit const Integrator symplectic_euler{
    .id = "symplectic_euler",
    .label = "Symplectic Euler (semi-implicit, modified Euler)",
    .summary = "One force evaluation per step and no energy drift: the method of most games, first order.",
    .cost = "one force evaluation per step",
    .formula =
        "v' = E v + phi a(x, v),   E = e^(-c h), phi = (1 - E) / c\n"
        "x' = x + h v'",
    .source = "R. de Vogelaere, 1956; E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, I.1",
    .order = 1,
    .order_with = {.drag = 1, .damped = 1, .contact = 1, .force_terms = 1},
    .stability = Stability::Conditional,
    .energy = EnergyTrend::Bounded,
    .for_production = false,
    .velocity_lag = 0.5,
    .step = step,
    .amplification = amplification,
    .modified_energy = modified_energy,
    .steps = steps,
};

}  // namespace hooke
