// Springs as compliant constraints, one after another, once a step     (M. Macklin, M. Mueller, N. Chentanez, XPBD, MIG 2016;
// one iteration and small steps: M. Macklin et al., Small Steps in Physics Simulation, SCA 2019)
//   v = v E + phi g,  then for every spring:  v_i += w_i J u,  v_j -= w_j J u,   and x' = x + h v,
//   J = -(phi k (l - l0) + phi d (v_i - v_j).u) / (1 + phi (h k + d)(w_i + w_j)),   l and u at x + h v,
// E = e^(-c h), phi = (1 - E) / c (h when c = 0), w = 1 / m. With phi = h this is the paper's correction of positions
// lambda = (-C - gamma grad C.(x - x_n)) / ((1 + gamma) w + alpha / h^2), alpha = 1 / k, gamma = d / (k h), times k h. Departures:
// corrections go to the velocity, so that (x' - x) / h leaves no floor at small steps; phi in place of h gives drag its
// exact decay and keeps equilibria where they are.
// Each spring alone is damped as by implicit Euler; coupled springs converge only as far as one sweep reaches, so that long chains, or
// chains of very different masses, are far too soft. The order of the springs decides whether the motion stays bounded: springs of one
// color share no point and are processed along one direction of a grid after another.
#include "sim/forces/constraints.h"
#include "sim/forces/forces.h"
#include "sim/forces/kick.h"
#include "sim/forces/spring_laws.h"
#include "sim/methods/linear_spring.h"
#include "sim/methods/rows.h"

namespace hooke {
namespace {

void prepare(const Plan& plan, double h, const Motion&, Workspace& work) {
  make_structure<Constraints>(plan, work).prepare(plan, h, kick_over(plan.drag, h).weight);
}

// The hand's spring has no rest length: all of its displacement is along it.
void pull(const Plan& plan, Motion& motion, double h) {
  const PlannedPull& hand = *plan.hand.pull;
  const double k = hand.stiffness, phi = kick_over(plan.drag, h).weight;
  double w = 0.0;
  for (const auto& [point, weight] : hand.points()) w += weight * weight * plan.inverse_mass[point];
  const double stiffness = phi * k / (1.0 + phi * h * k * w);
  const Vec3 stretch = pull_stretch(plan, motion.x, motion.time + h) + h * pulled_mean(plan, motion.v);
  for (const auto& [point, weight] : hand.points())
    add_vector(plan, motion.v, point, free_part(plan, point, -plan.inverse_mass[point] * weight * stiffness * stretch));
}

void step(const Plan& plan, Motion& motion, Workspace& work, double h) {
  // gravity alone is constant
  if (!motion.acceleration_is_current || !plan.forces.empty()) {
    compute_external_forces(plan, motion.time, motion.x, motion.v, motion.a);
    divide_by_mass(plan, motion.a);
    motion.acceleration_is_current = true;
  }

  kick(plan, motion, h);
  structure_of<Constraints>(work).sweep(plan, h, motion.x, motion.v);
  project_laws(plan, h, kick_over(plan.drag, h).weight, motion.time + h, motion.x, motion.v);
  if (plan.hand.pull) pull(plan, motion, h);
  ++motion.counts.sweeps;

  drift(motion, h);
}

}  // namespace

constinit const Integrator xpbd{
    .id = "xpbd",
    .label = "XPBD, one iteration",
    .summary = "Stiff cloth in real time with large errors: bounded at steps far beyond the explicit limit, and too soft there.",
    .cost = "one sweep over the springs per step",
    .formula =
        "v = E v + phi g,   E = e^(-c h), phi = (1 - E) / c\n"
        "for every spring:  J = -phi (k (l - l0) + d (v_i - v_j).u) / (1 + phi (h k + d)(w_i + w_j)),   l, u at x + h v, w = 1/m\n"
        "                   v_i += w_i J u,  v_j -= w_j J u\n"
        "x' = x + h v",
    .source = "M. Macklin, M. Mueller, N. Chentanez, XPBD, MIG 2016; M. Macklin et al., Small Steps in Physics Simulation, SCA 2019",
    .order = 1,
    .order_with = {.drag = 1, .damped = 1, .contact = 1, .force_terms = 1},
    .stability = Stability::EachSpring,
    .energy = EnergyTrend::Falls,
    .velocity_lag = 0.5,
    .prepare = prepare,
    .step = step,
    .amplification = amplification_of_linear_spring,
};

}  // namespace hooke
