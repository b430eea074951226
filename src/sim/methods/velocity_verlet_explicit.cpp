// Velocity Verlet with dashpots and forces that depend on velocity among the forces, evaluated once per step at the velocity w predicted
// for its end; the next step's first kick has the same acceleration:
//   v = v E + a phi,  x = x + h v,  w = v E + a phi,  a = a(x, w),  v = v E + a phi     (Groot and Warren 1997, eq. 11 with lambda = 1)
// with E = e^(-c h/2), phi = (1 - E) / c (h/2 when c = 0). Second order, conserves momentum, symplectic when undamped. Dashpots limit the
// step: without drag it is stable for (h omega)^2 / 4 + h lambda < 1.
#include "sim/forces/energy/plan_energy.h"
#include "sim/forces/kick.h"
#include "sim/forces/leapfrog_pass.h"
#include "sim/methods/rows.h"

namespace hooke {
namespace {

void prepare(const Plan&, double, const Motion& motion, Workspace& work) { work.size_fields(1, motion); }

void kick_and_drift_first(const Plan& plan, Motion& motion, Field& predicted, double h) {
  PassVelocities velocities{.predicted = &predicted, .ahead = 0.5 * h};
  if (motion.acceleration_is_current) return kick_and_drift(plan, motion, 0.5 * h, h, velocities);
  velocities.acting = &motion.v;
  accelerate_kick_and_drift(plan, motion.time, motion, 0.5 * h, h, velocities);
}

void kick_last(const Plan& plan, double time, Motion& motion, const Field& predicted, double h) {
  accelerate_kick_and_drift(plan, time, motion, 0.5 * h, 0.0, {.acting = &predicted});
  motion.acceleration_is_current = true;
}

void step(const Plan& plan, Motion& motion, Workspace& work, double h) {
  kick_and_drift_first(plan, motion, work.fields[0], h);
  kick_last(plan, motion.time + h, motion, work.fields[0], h);
}

// The last kick of a step and the first of the next are one of h.
void steps(const Plan& plan, Motion& motion, Workspace& work, double h, int count) {
  Field& predicted = work.fields[0];
  kick_and_drift_first(plan, motion, predicted, h);
  motion.time += h;
  repeat_kick_and_drift(plan, motion, h, count - 1, {.acting = &predicted, .predicted = &predicted, .ahead = 0.5 * h});
  kick_last(plan, motion.time, motion, predicted, h);
}

double modified_energy(const Plan& plan, const Motion& motion, double h) {
  return verlet_energy_difference(plan, motion.time, motion.x, motion.v, h);
}

// With u the velocity at the middle of a step, r = h (lambda + q) and units of h, an eigenvector with the eigenvalue z has
//   (z - 1) x = z u,   (z - E^2) u = phi (1 + E) a,   a = -omega^2 x - r (E u + phi a / z)
Amplification amplification(const Oscillator& oscillator) {
  const auto [decay, phi] = kick_over(oscillator.h_drag, 0.5);
  const double whole_decay = decay * decay, whole_phi = phi * (1.0 + decay), rate = oscillator.h_lambda + oscillator.h_rate;
  const double of_middle = rate * decay * whole_phi, of_last = rate * phi;
  return {.trace = 1.0 + whole_decay - of_last - of_middle - oscillator.h_omega_squared * whole_phi,
          .determinant = whole_decay - of_last * (1.0 + whole_decay) - of_middle,
          .third = -of_last * whole_decay};
}

}  // namespace

constinit const Integrator velocity_verlet_explicit{
    .id = "velocity_verlet_explicit",
    .label = "Verlet, explicit damping",
    .summary = "Velocity Verlet for weak dashpots and wind: faster, because all forces are evaluated once per step.",
    .cost = "one force evaluation per step",
    .formula =
        "v = E v + phi a,   E = e^(-c h/2), phi = (1 - E) / c\n"
        "x' = x + h v\n"
        "a' = a(x', w),   w = E v + phi a\n"
        "v' = E v + phi a'",
    .source = "R. D. Groot, P. B. Warren, J. Chem. Phys. 107 (1997) 4423-4435, lambda = 1",
    .order = 2,
    .order_with = {.drag = 2, .damped = 2, .contact = 2, .force_terms = 2},
    .stability = Stability::Conditional,
    .energy = EnergyTrend::Bounded,
    .prepare = prepare,
    .step = step,
    .amplification = amplification,
    .modified_energy = modified_energy,
    .steps = steps,
};

}  // namespace hooke
