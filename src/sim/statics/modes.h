// The slowest and the fastest swing of a scene about where it is at rest, and how fast the dashpots take them away.
#pragma once

#include <optional>
#include <vector>

#include "sim/implicit/stiffness.h"

namespace hooke {

// A solution u of K u = omega^2 M u.
struct Mode {
  double omega = 0.0;  // [rad/s], undamped
  // [1/s], u.D u / u.M u: what its velocity loses a second, as to the drag the drag's c. NaN: several swing as fast, and lose
  // differently.
  double dashpot_rate = 0.0;
};

// Both by Lanczos' method (C. Lanczos 1950) with full reorthogonalisation, from M^-1/2 K M^-1/2 for the fastest and from
// (1 + b^2 M^-1/2 K M^-1/2)^-1 for the slowest that is not loose: what nothing drives back, as a body that floats, is no swing.
// The plan must be of springs alone, without dashpots and drag; `damping` [N s/m] of its packed springs, empty: none. `loose`:
// what swings so much slower than the fastest mode may, counts as loose; x must be exact enough to tell.
// None where nothing swings, or where the method has not found it to a percent.
std::optional<Mode> fastest_mode(const Plan& plan, const std::vector<double>& damping, const Field& x);
std::optional<Mode> slowest_mode(const Plan& plan, const std::vector<double>& damping, const Field& x, double rigid_mode_ratio,
                                 StiffnessMatrix& matrix);

}  // namespace hooke
