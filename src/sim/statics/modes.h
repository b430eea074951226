// The slowest and the fastest normal mode of a scene about its equilibrium, and their damping by the dashpots.
#pragma once

#include <optional>
#include <vector>

#include "sim/methods/implicit/stiffness.h"

namespace hooke {

// A solution u of K u = omega^2 M u.
struct Mode {
  double omega = 0.0;  // [rad/s], undamped
  // [1/s], u.D u / u.M u: decay rate of its velocity, comparable to the drag c. NaN: several modes have this frequency and
  // different rates.
  double dashpot_rate = 0.0;
  std::vector<double> shape{};  // u, in the layout of the Plan, with u.M u = 1
};

// Both by Lanczos' method (C. Lanczos 1950) with full reorthogonalization, from M^-1/2 K M^-1/2 for the fastest and from
// (1 + b^2 M^-1/2 K M^-1/2)^-1 for the slowest that is not a rigid motion, which has no restoring force.
// The plan must consist of springs only, without dashpots and drag; `damping` [N s/m] of its packed springs, empty: none. Modes slower than
// rigid_mode_ratio times the bound on the fastest count as rigid; x must be accurate enough to distinguish them.
// None without modes, or if the method has not converged to a percent.
std::optional<Mode> fastest_mode(const Plan& plan, const std::vector<double>& damping, const Field& x);
std::optional<Mode> slowest_mode(const Plan& plan, const std::vector<double>& damping, const Field& x, double rigid_mode_ratio,
                                 StiffnessMatrix& matrix);

}  // namespace hooke
