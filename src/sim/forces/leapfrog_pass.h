// Kicks and drifts of all points, each fused with the forces into one pass over the springs where the plan allows it.
#pragma once

#include "sim/forces/motion.h"

namespace hooke {

// The velocity at which dashpots and listed forces act in a pass; null: dashpots do not act at all, and listed forces at motion.v. Where
// `predicted` is given, which may be the same field, the velocity that a further kick by `ahead` [s] with the same acceleration would give
// goes to it.
struct PassVelocities {
  const Field* acting = nullptr;
  Field* predicted = nullptr;
  double ahead = 0.0;
};

// With the accelerations motion.a: kick by `kick` [s], then drift by `drift` [s], as in motion.h.
void kick_and_drift(const Plan& plan, Motion& motion, double kick, double drift, const PassVelocities& velocities = {});

// Sets motion.a to the accelerations at `time` [s] and motion.x, without drag; then as kick_and_drift. With an acting velocity, sets
// motion.power to that of the listed forces, if there are any.
void accelerate_kick_and_drift(const Plan& plan, double time, Motion& motion, double kick, double drift,
                               const PassVelocities& velocities = {});

// One of the two, for the first kick of a step that begins at motion.time: motion.a may be that of the last kick of the step before.
void start_kick_and_drift(const Plan& plan, Motion& motion, double kick, double drift);

// `steps` times the same in a scene without listed forces and hand, with kicks and drifts by h [s] each; adds to motion.time and to the
// force evaluations; motion.a is not set. In single precision if the plan is computed in it.
void repeat_kick_and_drift(const Plan& plan, Motion& motion, double h, int steps, const PassVelocities& velocities = {});

}  // namespace hooke
