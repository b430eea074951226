// Where the springs and the weight of a scene come to rest.
#pragma once

#include <atomic>

#include "sim/implicit/stiffness.h"

namespace hooke {

// From x down to a minimum of the potential energy, sum k (l - l0)^2 / 2 - sum m a.x: Newton's method,
//   (M / b^2 + K) s = f,   x' = x + s,
// the first term keeping what is loose from going far at a time; b grows as the steps get shorter (a pseudo-transient
// continuation, C. T. Kelley, D. E. Keyes 1998). K is clamped (stiffness.h) until the exact one is positive, near the minimum.
// The plan must be of springs and weight alone, without dashpots, drag, hand and listed forces; colliders do not count. Ends
// when `small` [N] is all that is left of the forces, RMS over the points, or after `max_steps`. Returns what is left [N].
double find_equilibrium(const Plan& plan, StiffnessMatrix& matrix, double tolerance, int max_steps, Field& x,
                        const std::atomic<bool>& stop);

}  // namespace hooke
