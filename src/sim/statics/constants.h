// The numbers of this module that change results.
#pragma once

namespace hooke {

// [1] Below this residual, relative to the tolerance, the equilibrium is sought with the exact curvature. Farther away the matrix is hardly
// ever positive definite.
inline constexpr double max_exact_residual = 1e5;
// Lanczos' method: steps, and the relative error [1] of an eigenvalue, which is the square of a frequency.
inline constexpr int max_lanczos_steps = 40;
inline constexpr double eigenvalue_tolerance = 0.02;
// [1] Two modes of a frequency count as one if their dampings differ by at most this, relative to the damping and to the frequency.
inline constexpr double same_damping = 0.1, same_damping_of_frequency = 1e-6;

}  // namespace hooke
