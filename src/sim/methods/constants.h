// The numbers of this module that change results, besides the coefficients of the methods, which are in their files.
#pragma once

#include <cstdint>

#include "base/types.h"

namespace hooke {

// [1] The recommended step is the linear limit divided by this. The limit holds for small oscillations. Nets that rotate and stretch can
// gain energy at smaller steps. Of 120 random nets started far from equilibrium, none did at the recommended step
// (docs/reference/methods.md).
inline constexpr int default_margin = 4;
// [1] The same where springs pass through zero length (sim/forces/energy/energy.h): their direction reverses within a step, which no
// frequency describes. In most of 2000 random nets they do. Up to 79 of these nets gain more than 20 % of their energy in 3 s at the
// default margin, and up to 3 at this one (docs/reference/methods.md).
inline constexpr int collapse_margin = 16;

// [1] Eigenvalues may exceed the unit circle by this much, from rounding.
inline constexpr double eigenvalue_round_off = 1e-12;
// [1] Up to this h omega, contacts cause no growth with methods that are stable at any step. On a cloth on a ball some methods grow from 4,
// on a pile of bars, whose ends touch each other, from 2.1 (tests/sim/contact_step_test.cpp).
inline constexpr double max_angle_in_contact = 3.0, max_angle_of_touching_points = 1.8;
// [1] Up to this h omega, the derivatives that an implicit method leaves out cause no growth. On sheets in strong wind, implicit_midpoint
// gains energy in some from 1.3, the L-stable methods from 3.2.
inline constexpr double max_omitted_angle = 1.0;

// Of dop853 (E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., II.4 and the code DOP853): bounds on
// the change of the step, the exponent of the error before, the safety factor and the least error that counts, all [1].
inline constexpr double min_step_factor = 1.0 / 3.0, max_step_factor = 6.0, step_beta = 0.04, step_safety = 0.9, min_step_error = 1e-4;
// [1], relative to the coordinates, of rounding in the error of methods that adapt their step.
inline constexpr double error_round_off = 1e-14;

// Newton's method. [1] Above `max_contraction`, a new factorization is cheaper than more iterations. Above `max_exact_stiffness` (b omega),
// exact curvature is not tried far from the solution. The first `max_force_updates` iterations update listed forces, of which some are not
// continuous. After about `max_newton_factorizations`, iterations reuse the last matrix.
inline constexpr double max_contraction = 0.25, max_exact_stiffness = 10.0;
inline constexpr int max_force_updates = 10, max_newton_iterations = 100, max_newton_factorizations = 20;
// [1], Armijo's constant (J. Nocedal, S. Wright, Numerical Optimization, 2nd ed., 3.1), rounding of the potential, and the shortest part of
// a step that is tried.
inline constexpr double armijo = 1e-4, potential_round_off = 1e-14, min_newton_step = 1e-9;
// [1], rounding of a position.
inline constexpr double position_round_off = 2e-16;

// [1], of Chebyshev's acceleration (H. Wang, A Chebyshev semi-iterative approach, SIGGRAPH Asia 2015).
inline constexpr double max_spectral_radius = 0.95;

// Of a factor: 2.4 GB.
inline constexpr std::int64_t max_factor_entries = 300'000'000;

}  // namespace hooke
