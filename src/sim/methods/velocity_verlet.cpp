// Kick h/2, drift h, kick h/2:  v = v E + a(x) phi,  x = x + h v,  v = v E + a(x) phi     (Stoermer-Verlet)
// with E = e^(-c h/2), phi = (1 - E) / c (h/2 when c = 0). Dashpots are split off: each is solved exactly, in a forward
// sweep of h/2 before and a backward sweep of h/2 after (dashpot.h). Second order, symplectic when undamped,
// stable for h omega < 2 whatever the dashpots.
//
// In large nets, weak dashpots are among the forces instead: one pass over the springs per step instead of three. They act at the velocity
// predicted for the end of the step, w = E v + phi a with v after the drift, and in the first kick of the next step at the same:
//   v = v E + a phi,  x = x + h v,  a = a(x, w),  v = v E + a phi     (Groot and Warren 1997, eq. 11 with lambda = 1)
// This is of second order too, and conserves momentum. On nets that vibrate at all frequencies its error is 0 to 10 % smaller.
//
// Forces g that depend on velocity are evaluated at v for the first kick and at
// E v + phi a for the last one, which keeps the second order and costs a second evaluation of them per step. In large nets, weak ones are
// evaluated once, at the velocity w that the end of the step would have if they were still g, and act with that in the next step's first
// kick, too:
//   v = v E + (a + g) phi,  x = x + h v,  w = v E + (a(x) + g) phi,  v = w + (g(x, w) - g) phi,  g = g(x, w)
// w differs from the v that follows by no more than the change of g within a step: with a rate of r [1/s], by the order of h r.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "sim/forces/dashpots/dashpot.h"
#include "sim/forces/energy/plan_energy.h"
#include "sim/forces/field_kernel.h"
#include "sim/forces/flight.h"
#include "sim/forces/forces.h"
#include "sim/forces/spring_limits.h"
#include "sim/methods/rows.h"
#include "sim/model/portable_math.h"

namespace hooke {
namespace {

// Whether the dashpots are forces: where sweeps over them would take most of the time, they are weak beside the springs and within a step,
// so that the error is that of the sweeps, and the step is well within its limit, which is then (h omega)^2 / 4 + h lambda < 1.
bool are_dashpots_weak(const Plan& plan, double h) {
  constexpr double max_ratio = 0.25, max_rate = 0.3, margin = 0.9;
  const double h_omega = h * plan.spectrum.omega, h_lambda = h * plan.spectrum.dashpot_rate;
  return plan.springs >= min_springs_of_grids && h_lambda <= max_rate && h_lambda <= max_ratio * h_omega &&
         0.25 * h_omega * h_omega + h_lambda <= margin;
}
bool has_weak_dashpots(const Plan& plan, double h) {
  return plan.has_dashpots() && !plan.force_data.depend_on_velocity && are_dashpots_weak(plan, h);
}

// Whether the listed forces, some of which depend on velocity, are evaluated once per step. All must work by a power, which is that
// of the evaluation. Sweeps over dashpots would change the velocity after it.
bool has_weak_forces(const Plan& plan, double h) {
  constexpr double max_rate = 0.1;
  const auto works_by_power = [](const Force& force) { return force.term->power != nullptr && force.term->potential == nullptr; };
  return plan.force_data.depend_on_velocity && plan.springs >= min_springs_of_grids &&
         h * (plan.spectrum.force_rate + plan.spectrum.estimated_rate) <= max_rate && std::ranges::all_of(plan.forces, works_by_power) &&
         (!plan.has_dashpots() || are_dashpots_weak(plan, h));
}

void prepare(const Plan& plan, double h, const Motion& motion, Workspace& work) {
  work.size_fields(plan.force_data.depend_on_velocity ? 2 : plan.has_dashpots() ? 1 : 0, motion);
  if (plan.has_dashpots() && !has_weak_dashpots(plan, h) && !has_weak_forces(plan, h)) work.dashpots.prepare(plan, 0.5 * h);
}

void accelerate(const Plan& plan, double time, Motion& motion) {
  compute_position_forces(plan, time, motion.x, motion.v, motion.a);
  divide_by_mass(plan, motion.a);
  ++motion.counts.force_evaluations;
}

void accelerate_and_kick_half(const Plan& plan, double time, Motion& motion, double h) {
  if (can_accelerate_and_kick(plan)) {
    accelerate_and_kick(plan, time, motion, 0.5 * h, 0.0);
    ++motion.counts.force_evaluations;
  } else {
    accelerate(plan, time, motion);
    kick(plan, motion, 0.5 * h);
  }
}

// With forces that depend on velocity: the two evaluations at the end of a step and at the start of the next have the same unlisted
// forces. Without sweeps in between, the second one is made together with the power of the listed forces.
void kick_and_drift_with_velocity(const Plan& plan, Motion& motion, Workspace& work, double h) {
  using enum Motion::Forces;
  Field& velocity = work.fields[1];
  if (!motion.acceleration_is_current || motion.contents == None) {
    compute_unlisted_forces(plan, motion.time, motion.x, motion.forces);
    motion.contents = Unlisted;
  }
  if (motion.contents != Complete) add_force_terms(plan, motion.time, motion.x, motion.v, motion.forces);
  // with the velocity at the end of the step
  kick_and_drift_with_forces(plan, motion, motion.forces, 0.5 * h, h, {.predicted = &velocity, .ahead = 0.5 * h});

  compute_unlisted_forces(plan, motion.time + h, motion.x, motion.forces);
  motion.contents = plan.has_dashpots() ? Unlisted : Open;
  motion.a = motion.forces;
  add_force_terms(plan, motion.time + h, motion.x, velocity, motion.a);
  kick_and_drift_with_forces(plan, motion, motion.a, 0.5 * h, 0.0, {});
  motion.counts.force_evaluations += 2;
}

// The forces at the end of the step from those in motion.forces, which contain gravity.
void complete_weak_forces(const Plan& plan, Motion& motion, Field& next, double h) {
  compute_external_forces(plan, motion.time + h, motion.x, motion.v, next);
  const double phi = plan.drag == 0.0 ? 0.5 * h : -portable::expm1(-0.5 * plan.drag * h) / plan.drag;
  std::array<double, partial_sums> power{};
  for (int c = 0; c < plan.dimensions; ++c) {
    const std::size_t begin = static_cast<std::size_t>(c) * plan.points;
    change_forces({.before = motion.forces.data() + begin,
                   .after = next.data() + begin,
                   .mass = plan.mass.data(),
                   .inverse_mass = plan.inverse_mass.data(),
                   .weight = phi,
                   .g = plan.acceleration[c]},
                  motion.v.data() + begin, motion.a.data() + begin, power, plan.mass.size());
  }
  motion.power = std::accumulate(power.begin(), power.end(), 0.0);
  std::swap(motion.forces, next);
}

// With all forces but those of the springs and the hand in motion.forces.
void accelerate_and_kick_with_forces(const Plan& plan, double time, Motion& motion, double kick, double drift,
                                     const PassDashpots& dashpots) {
  if (can_accelerate_and_kick_with(plan)) {
    accelerate_and_kick_with(plan, motion.forces, motion, kick, drift, dashpots);
  } else {
    std::ranges::copy(motion.forces, motion.a.begin());
    add_inner_forces(plan, time, motion.x, dashpots.velocity, motion.a);
    divide_by_mass(plan, motion.a);
    Flight alone;
    kick_and_drift_with_known(plan, motion, kick, drift, {.predicted = dashpots.predicted, .ahead = dashpots.ahead}, alone);
  }
  ++motion.counts.force_evaluations;
}

// Weak dashpots, if there are any, are among the forces as above.
void step_with_weak_forces(const Plan& plan, Motion& motion, Workspace& work, double h) {
  Field& velocity = work.fields[1];
  motion.moved = {};
  const bool damped = plan.has_dashpots();
  PassDashpots first, last;
  if (damped) {
    first = {.predicted = &velocity, .ahead = 0.5 * h};
    last = {.velocity = &velocity};
  }
  if (motion.acceleration_is_current && motion.contents == Motion::Forces::External) {
    Flight alone;
    kick_and_drift_with_known(plan, motion, 0.5 * h, h, first, alone);
  } else {
    compute_external_forces(plan, motion.time, motion.x, motion.v, motion.forces);
    if (damped) first.velocity = &motion.v;
    accelerate_and_kick_with_forces(plan, motion.time, motion, 0.5 * h, h, first);
  }
  accelerate_and_kick_with_forces(plan, motion.time + h, motion, 0.5 * h, 0.0, last);
  complete_weak_forces(plan, motion, work.fields[0], h);
  motion.contents = Motion::Forces::External;
  motion.acceleration_is_current = true;
}

void kick_and_drift_alone(const Plan& plan, Motion& motion, double h) {
  if (!motion.acceleration_is_current && can_accelerate_and_kick(plan)) {
    accelerate_and_kick(plan, motion.time, motion, 0.5 * h, h, {}, std::exchange(motion.moved, {}));
    ++motion.counts.force_evaluations;
  } else {
    if (!motion.acceleration_is_current) accelerate(plan, motion.time, motion);
    kick(plan, motion, 0.5 * h);
    drift(motion, h);
  }
  accelerate_and_kick_half(plan, motion.time + h, motion, h);
}

// The accelerations at motion.x, with dashpots that act at `velocity`.
void accelerate_damped(const Plan& plan, double time, const Field& velocity, Motion& motion) {
  compute_explicit_forces(plan, time, motion.x, velocity, motion.a);
  divide_by_mass(plan, motion.a);
  ++motion.counts.force_evaluations;
}

void accelerate_damped_and_kick(const Plan& plan, double time, const Field& velocity, Motion& motion, double h) {
  if (can_accelerate_and_kick(plan)) {
    accelerate_and_kick(plan, time, motion, 0.5 * h, 0.0, {.velocity = &velocity});
    ++motion.counts.force_evaluations;
  } else {
    accelerate_damped(plan, time, velocity, motion);
    kick(plan, motion, 0.5 * h);
  }
  motion.acceleration_is_current = true;
}

// Weak dashpots act at v' = E v + phi a, the velocity at the end of the step if the acceleration remains that of its start, and at that in
// the first kick of the next step too.
void fly_weakly_damped(const Plan& plan, Motion& motion, Workspace& work, double h, int count, Flight& flight) {
  Field& velocity = work.fields[0];
  if (!motion.acceleration_is_current) accelerate_damped(plan, motion.time, motion.v, motion);
  kick_and_drift_with_known(plan, motion, 0.5 * h, h, {.predicted = &velocity, .ahead = 0.5 * h}, flight);
  motion.time += h;
  kick_and_drift_steps(plan, motion, h, count - 1, {.velocity = &velocity, .predicted = &velocity, .ahead = 0.5 * h}, flight);
  accelerate_damped_and_kick(plan, motion.time, velocity, motion, h);
}

void step_weakly_damped(const Plan& plan, Motion& motion, Workspace& work, double h) {
  Field& velocity = work.fields[0];
  // the accelerations known elsewhere are at predicted velocities, not at those of the state
  motion.moved = {};
  if (!motion.acceleration_is_current && can_accelerate_and_kick(plan)) {
    accelerate_and_kick(plan, motion.time, motion, 0.5 * h, h, {.velocity = &motion.v, .predicted = &velocity, .ahead = 0.5 * h});
    ++motion.counts.force_evaluations;
  } else {
    if (!motion.acceleration_is_current) accelerate_damped(plan, motion.time, motion.v, motion);
    Flight alone;
    kick_and_drift_with_known(plan, motion, 0.5 * h, h, {.predicted = &velocity, .ahead = 0.5 * h}, alone);
  }
  accelerate_damped_and_kick(plan, motion.time + h, velocity, motion, h);
}

void step(const Plan& plan, Motion& motion, Workspace& work, double h) {
  if (has_weak_dashpots(plan, h)) return step_weakly_damped(plan, motion, work, h);
  if (has_weak_forces(plan, h)) return step_with_weak_forces(plan, motion, work, h);
  if (plan.has_dashpots()) work.dashpots.sweep(plan, SweepDirection::Forward, motion.acceleration_is_current, motion.x, motion.v);
  if (plan.force_data.depend_on_velocity)
    kick_and_drift_with_velocity(plan, motion, work, h);
  else
    kick_and_drift_alone(plan, motion, h);
  motion.acceleration_is_current = true;
  if (plan.has_dashpots()) work.dashpots.sweep(plan, SweepDirection::Backward, false, motion.x, motion.v);
  motion.counts.dashpot_sweeps += plan.has_dashpots() ? 2 : 0;
}

// Drag and dashpots are left out: they do not conserve energy.
double modified_energy(const Plan& plan, const Motion& motion, double h) {
  return verlet_energy_difference(plan, motion.time, motion.x, motion.v, h);
}

// The last kick of a step and the first of the next are one of h; forces are evaluated within the pass that kicks and drifts.
void fly_damped(const Plan& plan, Motion& motion, Workspace& work, double h, int count, Flight& flight) {
  for (int i = 0; i < count && !flight.was_interrupted(); ++i) {
    if (i > 0) flight.any_at_limit = flight.any_at_limit || any_reaches_limit(plan, plan.spring.runs, motion.x);
    work.dashpots.sweep(plan, SweepDirection::Forward, motion.acceleration_is_current, motion.x, motion.v);
    if (!motion.acceleration_is_current) accelerate(plan, motion.time, motion);
    kick_and_drift_with_known(plan, motion, 0.5 * h, h, {}, flight);
    motion.time += h;
    accelerate_and_kick_half(plan, motion.time, motion, h);
    motion.acceleration_is_current = true;
    work.dashpots.sweep(plan, SweepDirection::Backward, false, motion.x, motion.v);
    motion.counts.dashpot_sweeps += 2;
  }
}

void fly(const Plan& plan, Motion& motion, Workspace& work, double h, int count, Flight& flight) {
  if (has_weak_dashpots(plan, h)) return fly_weakly_damped(plan, motion, work, h, count, flight);
  if (plan.has_dashpots()) return fly_damped(plan, motion, work, h, count, flight);
  if (!motion.acceleration_is_current) accelerate(plan, motion.time, motion);
  kick_and_drift_with_known(plan, motion, 0.5 * h, h, {}, flight);
  motion.time += h;
  kick_and_drift_steps(plan, motion, h, count - 1, {}, flight);
  accelerate_and_kick_half(plan, motion.time, motion, h);
  motion.acceleration_is_current = true;
}

// The columns of the step's matrix on (x, h v), with E and phi per half step.
Amplification amplification(const Oscillator& oscillator) {
  const double decay = portable::exp(-0.5 * oscillator.h_drag), dashpot = portable::exp(-0.5 * oscillator.h_lambda);
  const double phi = oscillator.h_drag == 0.0 ? 0.5 : -portable::expm1(-0.5 * oscillator.h_drag) / oscillator.h_drag;
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
    .cost = "one force evaluation per step; two sweeps over the dashpots, unless they are weak",
    .formula =
        "dashpots over h/2, each exactly, forward\n"
        "v = E v + phi a(x),   E = e^(-c h/2), phi = (1 - E) / c\n"
        "x' = x + h v\n"
        "v' = E v + phi a(x')\n"
        "dashpots over h/2, backward\n"
        "weak ones, in nets of 256 springs and more, are part of a: a(x', w) with w = E v + phi a, also in the next step\n"
        "weak forces that depend on velocity, there: at w = E v + phi a, a with those of the last step, also in the next step",
    .source =
        "C. Stoermer, 1907; L. Verlet, Phys. Rev. 159 (1967) 98-103; W. C. Swope et al., J. Chem. Phys. 76 (1982) 637-649; splitting: G. "
        "Strang, 1968; weak dashpots: R. D. Groot, P. B. Warren, J. Chem. Phys. 107 (1997) 4423-4435",
    .order = 2,
    .order_drag = 2,
    .order_damped = 2,
    .order_contact = 2,
    .order_friction = 1,
    .order_force_terms = 2,
    .stability = Stability::Conditional,
    .energy = EnergyTrend::Bounded,
    .symplectic = true,
    .implicit_solve = ImplicitSolve::None,
    .implicit_force_terms = false,
    .for_production = true,
    .kicks_last = true,
    .splits_dashpots = true,
    .prepare = prepare,
    .step = step,
    .amplification = amplification,
    .modified_energy = modified_energy,
    .fly = fly,
};

}  // namespace hooke
