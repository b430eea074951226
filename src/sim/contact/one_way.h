// Walls as those of XSpringies 1.12.
#pragma once

#include "sim/contact/contact.h"

namespace hooke {

// Points that cross the planes of Plan::one_way from the free side in this substep rebound: the restitution multiplies the normal velocity
// and the tangential one. Sticky planes take strength x 1 s / mass off the rebound; a point that would not leave stops, and is held while
// forces pull at it or press with less than the strength. Points that start behind a plane are free. Books the work. Returns whether any
// point was moved.
bool rebound_from_walls(const Plan& plan, ContactWorkspace& before, double h, Motion& motion);

}  // namespace hooke
