// How far all points are from all colliders, as one number.
#pragma once

#include "sim/plan/plan.h"

namespace hooke {

// A lower bound [m] on the gap between the rim of any free point and any collider at its rest position; infinity without
// colliders, negative where a point may be inside.
double compute_clearance(const Plan& plan, const Field& x);

}  // namespace hooke
