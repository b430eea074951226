// The static equilibrium of springs and weight.
#pragma once

#include <atomic>

#include "sim/methods/implicit/stiffness.h"

namespace hooke {

// Minimizes the potential energy, sum k (l - l0)^2 / 2 - sum m a.x, starting at x, by Newton's method,
//   (M / b^2 + K) s = f,   x' = x + s,
// where the first term limits the motion of unconnected parts; b grows as the steps get shorter (pseudo-transient
// continuation, C. T. Kelley, D. E. Keyes 1998). K is clamped (stiffness.h) until the exact matrix is positive definite.
// The plan must consist of springs and weight only, without dashpots, drag, hand and listed forces; colliders are ignored. Ends
// when the RMS over the points of the residual force is at most `tolerance` [N], or after `max_steps`. Returns that residual [N].
double find_equilibrium(const Plan& plan, StiffnessMatrix& matrix, double tolerance, int max_steps, Field& x,
                        const std::atomic<bool>& stop);

}  // namespace hooke
