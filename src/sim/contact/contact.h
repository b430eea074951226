// Points against solid colliders: plane, sphere, box, each inflated by the point's radius; restitution and Coulomb
// friction.
#pragma once

#include "sim/contact/obstacle.h"
#include "sim/motion.h"

namespace hooke {

// Where each point was and how fast before a substep, and how the colliders move in it; sized once a frame.
struct ContactWorkspace {
  double time = 0.0;  // [s]
  Field x, v;
  std::vector<Obstacle> obstacles;
};

// Corrects the step of h that led from (before.x, before.v) to (motion.x, motion.v). A point's path within the step is
// the parabola through both positions under the step's mean acceleration; its impacts are solved for on it. Where it
// touches without bouncing it slides or sticks: its supports bear what presses into them, friction takes mu times that.
// Flights, impacts and slides on planes are exact under constant acceleration, slides on balls second order. Nothing
// passes through, whatever its speed; what starts inside is put on the surface; when all bounces to come fall within the
// step, they are over; what rests keeps its bits. All of it relative to colliders that move, which take their places at
// both ends of the step exactly and go between them as the points do; what they do to the points is added to
// motion.collider_work. A point that rubs on several that move differently is carried by their mean, weighed by friction.
// Returns whether anything touched.
bool resolve_contacts(const Plan& plan, ContactWorkspace& before, Motion& motion, double h);

}  // namespace hooke
