// The numbers of this module that change results.
#pragma once

namespace hooke {

// [1], the residual relative to the tolerance below which the equilibrium is sought with the exact curvature: farther away the matrix is
// hardly ever positive definite.
inline constexpr double max_exact_residual = 1e5;
// Lanczos' method: steps, and the error of an eigenvalue [1], which is the square of a frequency.
inline constexpr int max_lanczos_steps = 40;
inline constexpr double eigenvalue_tolerance = 0.02;
// [1], by which the damping of two modes of a frequency may differ, relative to the damping and to the frequency, to be that of one mode.
inline constexpr double same_damping = 0.1, same_damping_of_frequency = 1e-6;

}  // namespace hooke
