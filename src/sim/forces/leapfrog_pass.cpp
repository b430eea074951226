#include "sim/forces/leapfrog_pass.h"

#include "sim/forces/forces.h"
#include "sim/forces/grid_kernel.h"
#include "sim/forces/single_precision.h"
#include "sim/forces/spring_kernel.h"
#include "sim/forces/spring_laws.h"

namespace hooke {
namespace {

LeapfrogPass<double> pass_of(const Plan& plan, Motion& motion, double kick, double drift, const PassVelocities& velocities) {
  LeapfrogPass<double> pass = pass_over(plan, motion.x);
  pass.v = motion.v.data();
  pass.kick = kick_over(plan.drag, kick);
  pass.drift = drift;
  if (drift != 0.0) pass.drifted = motion.x.data();
  if (plan.has_dashpots() && velocities.acting != nullptr) pass.u = velocities.acting->data();
  if (velocities.predicted == nullptr) return pass;
  pass.w = velocities.predicted->data();
  pass.prediction = kick_over(plan.drag, velocities.ahead);
  return pass;
}

// Forces of sticky planes and of rollers, which balance the sum of all others.
void accelerate_with_balancing_forces(const Plan& plan, double time, Motion& motion, const PassVelocities& velocities) {
  compute_unlisted_forces(plan, time, motion.x, plan.has_dashpots() ? velocities.acting : nullptr, motion.a);
  const Field& velocity = velocities.acting != nullptr ? *velocities.acting : motion.v;
  const double power = add_force_terms_with_power(plan, time, motion.x, velocity, motion.a);
  if (velocities.acting != nullptr) motion.power = power;
  divide_by_mass(plan, motion.a);
}

// Computes the forces of everything but grids into motion.a, if there are any besides gravity, for a pass that adds those of grids.
void compute_other_forces(const Plan& plan, double time, Motion& motion, const PassVelocities& velocities, LeapfrogPass<double>& pass) {
  if (!has_forces_outside_grids(plan)) return;
  if (velocities.acting != nullptr)
    motion.power = compute_external_forces_with_power(plan, time, motion.x, *velocities.acting, motion.a);
  else
    compute_external_forces(plan, time, motion.x, motion.v, motion.a);
  add_loose_spring_forces(plan, motion.x.data(), pass.u, motion.a.data());
  add_law_forces(plan, time, motion.x.data(), pass.u, motion.a.data());
  if (plan.hand.pull) add_pull(plan, time, motion.x, motion.a);
  pass.f = motion.a.data();
}

}  // namespace

void kick_and_drift(const Plan& plan, Motion& motion, double kick, double drift, const PassVelocities& velocities) {
  LeapfrogPass<double> pass = pass_of(plan, motion, kick, drift, velocities);
  pass.a = motion.a.data();
  advance_with_known(plan, pass);
}

void accelerate_kick_and_drift(const Plan& plan, double time, Motion& motion, double kick, double drift, const PassVelocities& velocities) {
  ++motion.counts.force_evaluations;
  if (plan.has_balancing_forces()) {
    accelerate_with_balancing_forces(plan, time, motion, velocities);
    return kick_and_drift(plan, motion, kick, drift, velocities);
  }
  LeapfrogPass<double> pass = pass_of(plan, motion, kick, drift, velocities);
  pass.a = motion.a.data();
  compute_other_forces(plan, time, motion, velocities, pass);
  advance(plan, pass, 1);
}

void start_kick_and_drift(const Plan& plan, Motion& motion, double kick, double drift) {
  if (motion.acceleration_is_current) return kick_and_drift(plan, motion, kick, drift);
  accelerate_kick_and_drift(plan, motion.time, motion, kick, drift);
}

void repeat_kick_and_drift(const Plan& plan, Motion& motion, double h, int steps, const PassVelocities& velocities) {
  LeapfrogPass<double> pass = pass_of(plan, motion, h, h, velocities);
  motion.acceleration_is_current = false;
  if (plan.execution.single != nullptr) {
    plan.execution.single->advance(plan, pass, steps, motion);
  } else if (plan.spring.loose_runs.empty()) {
    advance(plan, pass, steps);
  } else {
    for (int i = 0; i < steps; ++i) {
      compute_other_forces(plan, motion.time + i * h, motion, velocities, pass);
      advance(plan, pass, 1);
    }
  }
  motion.counts.force_evaluations += steps;
  motion.time += steps * h;
}

}  // namespace hooke
