// Whose work contact is: of what moves by itself and may supply energy, the hand or colliders, or of contact alone, which dissipates.
#pragma once

#include "sim/contact/obstacle.h"
#include "sim/forces/motion.h"

namespace hooke {

// Bounds on the work [J] of the hand and of colliders by contact in a substep. What exerts an impulse J while it moves at V does work of at
// most |J| |V|, whatever the method makes of the step.
struct SuppliedWork {
  double by_hand = 0.0, by_colliders = 0.0;
};

// Adds the work [J] of contact to that of the hand and of colliders, as far as they can have done it, and the rest to that of contact.
// Without the bounds, the energy that an unstable motion gains where something moves would count as supplied. Returns the rest.
double book_contact_work(double work, const SuppliedWork& bounds, Motion& motion);

// [m/s], of the held point; 0 without one.
double held_speed(const Plan& plan, const Motion& motion);

// A bound on the speed [m/s] of the surface of an obstacle near x in a substep of h.
double max_surface_speed(const Obstacle& obstacle, const Vec3& x, double h);

}  // namespace hooke
