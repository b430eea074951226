// Steps with nothing between them: no hand, contact or limit acts, so that kicks and drifts of all points fuse into one pass over
// the springs.
#pragma once

#include <cmath>
#include <limits>

#include "sim/forces/motion.h"

namespace hooke {

// How far the points got, as a bound for all of them.
struct Flight {
  double clearance = std::numeric_limits<double>::infinity();  // [m], between any point and any collider at the start
  double travel = 0.0;                                         // [m], since then
  double max_speed = 0.0;                                      // [m/s]
  double max_drift = 0.0;                                      // [s]
  bool any_at_limit = false;                                   // whether a spring may have reached the length at which something acts

  // Whether something may have acted between the steps. A point leaves the straight line of its drift by up to an eighth of the
  // change of its velocity times the step.
  bool was_interrupted() const {
    return any_at_limit || (std::isfinite(clearance) && !(travel + 0.25 * max_drift * max_speed < clearance));
  }
};

// Whether the forces on the points depend on nothing but their positions and, with their dashpots, the velocities of the springs' ends.
bool can_fly(const Plan& plan);

// The dashpots of a pass: they act at `velocity`, or not at all if it is null. Where `predicted` is given, which may be the same field, the
// velocity that a further kick by `ahead` [s] with the same acceleration would give goes to it.
struct PassDashpots {
  const Field* velocity = nullptr;
  Field* predicted = nullptr;
  double ahead = 0.0;
};

// From the forces of compute_position_forces at motion.time and motion.x, and those of the dashpots:
//   kick by `kick` [s], then drift by `drift` [s], as in motion.h.
// Uses motion.a as scratch.
void kick_and_drift(const Plan& plan, Motion& motion, double kick, double drift, const PassDashpots& dashpots, Flight& flight);

// `steps` times the same, with kicks and drifts by h [s] each, or until the flight was interrupted; adds to motion.time and to the force
// evaluations. In single precision if the plan is computed in it.
void kick_and_drift_steps(const Plan& plan, Motion& motion, double h, int steps, const PassDashpots& dashpots, Flight& flight);

// The same for a flight with the accelerations motion.a, which already contain the dashpots.
void kick_and_drift_with_known(const Plan& plan, Motion& motion, double kick, double drift, const PassDashpots& dashpots, Flight& flight);

// The same for the forces f [N], which contain all but drag, without a flight; motion.a remains.
void kick_and_drift_with_forces(const Plan& plan, Motion& motion, const Field& f, double kick, double drift, const PassDashpots& dashpots);

// Whether accelerate_and_kick takes no more than a pass over the springs. With listed forces, accelerate_and_kick_with does.
bool can_accelerate_and_kick(const Plan& plan);
bool can_accelerate_and_kick_with(const Plan& plan);

// Where can_accelerate_and_kick(plan): sets motion.a to the accelerations of compute_position_forces at `time` [s] and motion.x, and of the
// dashpots, kicks by `kick` [s] and drifts by `drift` [s], to the same bits as one after another. If motion.a is known but for what points
// `moved` have changed since, forces are computed only on the rows of grids beside these.
void accelerate_and_kick(const Plan& plan, double time, Motion& motion, double kick, double drift, const PassDashpots& dashpots = {},
                         const Motion::Moved& moved = {});

// The same where can_accelerate_and_kick_with(plan), with the forces of springs, of the dashpots, and `external` [N], all others.
void accelerate_and_kick_with(const Plan& plan, const Field& external, Motion& motion, double kick, double drift,
                              const PassDashpots& dashpots);

}  // namespace hooke
