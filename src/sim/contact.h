// Points against solid colliders: plane, sphere, box, each inflated by the point's radius; restitution and Coulomb
// friction.
#pragma once

#include "sim/motion.h"

namespace hooke {

// Where each point was and how fast before a substep; sized once a frame.
struct ContactWorkspace {
  Field x, v;
};

// Corrects the step of h that led from (before.x, before.v) to (motion.x, motion.v): every point's path within the step
// is taken as the parabola through both positions, the first impact is solved for on it, and the change of velocity at
// the impact is carried to the end of the step. Exact for flight under constant acceleration; nothing tunnels. A point
// whose remaining bounces all fall within the step comes to rest. Returns whether anything touched.
bool resolve_contacts(const Plan& plan, const ContactWorkspace& before, Motion& motion, double h);

}  // namespace hooke
