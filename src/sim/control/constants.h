// The numbers of this module that change results: what the method `auto` does, and how the error of a frame is measured. None depends on a
// scene.
#pragma once

namespace hooke::control {

// The controller aims at this part of the error allowed to a frame, because the estimate is not exact. scripts/tolerance counts the frames
// that exceed the allowed error without a report.
inline constexpr double safety = 0.5;
// Exponents of the proportional-integral controller, times 1 / order: K. Gustafsson, ACM Trans. Math. Softw. 17 (1991) 533-554.
inline constexpr double integral_gain = 0.7, proportional_gain = 0.4;
// A rejected frame is refined by at most this factor at once. (E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, IV.2, use
// 5 to 10.)
inline constexpr int max_growth = 8;
// Methods are compared again after so many rejections in one frame, or when the substeps of a frame have changed by the factor
// `selection_change` since the last comparison. A comparison costs a few frames.
inline constexpr int max_rejections = 3;
inline constexpr double selection_change = 4.0;
// Where stability sets the step and the error is below this part of what is aimed at, up to `max_unestimated` frames are not estimated. An
// error that doubles from frame to frame stays below the aim.
inline constexpr double calm_ratio = 0.02;
inline constexpr int max_unestimated = 3;
// [rad] or [1] Such a frame is estimated nevertheless if any spring may turn by more, or change its length by a larger part.
inline constexpr double max_turn = 0.25;
// [ms], and [1] relative to the frame before: a frame that would cost more ends with the error that it has, and a report.
inline constexpr double max_cost = 1000.0, max_cost_factor = 30.0;

// [ms] For `max_cost_factor`, the frame before counts as at least this long. A displayed frame is still longer than the product.
inline constexpr double short_frame = 0.5;
// [1] Cost of the runs of an estimate, relative to the last run: the one before has half of its substeps.
inline constexpr double cost_of_estimate = 1.5;

// [1] The largest factor by which half the step is assumed to reduce the error. Methods of second order are in their asymptotic range at the
// tolerances of an interactive program; methods of higher order often are not, and are treated as of second order.
inline constexpr double max_assumed_reduction = 4.0;
// [1] Up to this order, the path of a step is nearly the parabola that contact assumes.
inline constexpr int parabolic_order = 2;

// The error of a frame by a second run: factors [1] for the tolerance of a method that chooses its steps. The first corresponds to half the
// step of dop853 (order 8); the others are with contact, and without. The result is at least `min_tolerance` [m].
inline constexpr double tighter_as_half_step = 1.0 / 256.0, tighter_with_contact = 0.1, tighter = 1e-3, min_tolerance = 1e-15;
// A method may dissipate the fastest vibration: less than `kept_vibration` [1] of the square of its amplitude is left after a frame. Then
// the second run is that of a method that keeps it. Its substeps are shorter than the linear limit by `resolving_margin` [1], and than the
// decay of dashpots by `resolving_decay` [1]. It costs at most `cheap_run` [ms] or `cost_of_half_step` times the frame.
inline constexpr double kept_vibration = 0.8, resolving_margin = 1.5, resolving_decay = 0.25, cheap_run = 2.0, cost_of_half_step = 2.0;

// The model of the cost in [ns] on a core of 2023, measured with `hooke bench --kernels`, within a factor of 1.5. Only ratios matter, and
// they hardly depend on the machine.
// A force evaluation: each spring, each point, and the call. [1], of methods without fused kicks and drifts: passes over all points.
inline constexpr double spring_cost = 2.8, point_cost = 0.4, call_cost = 80.0, unfused_factor = 1.1;
// The strain limit: each spring in each sweep, and sweeps [1] that are expected.
inline constexpr double limit_cost = 5.0, expected_limit_sweeps = 5.0;
// Contact: a point with each collider; a point with others, and one of faces and springs, at the least, and as expected between a flight
// and a pile; a pair that is examined; an impulse.
inline constexpr double collider_cost = 10.0, neighbor_cost = 20.0, surface_cost = 200.0, expected_neighbor_cost = 400.0,
                        contact_test = 45.0, contact_impulse = 18.0;
// Sweeps over springs as constraints: each spring, each point, and the call; over dashpots: each.
inline constexpr double constraint_cost = 3.4, constraint_point_cost = 1.0, constraint_call_cost = 100.0, dashpot_cost = 2.6;
// A factorization: each point, and for each loop per point and the root of the points; a solution: each point, and for each loop per point
// and level of the elimination. In three dimensions. And iterations [1] of Newton's method that are expected.
inline constexpr double factor_cost = 200.0, factor_loop_cost = 14.0, solve_cost = 135.0, solve_loop_cost = 7.0;
inline constexpr int expected_iterations = 4;

}  // namespace hooke::control
