// Numbers that decide what the method `auto` does. None depends on a scene.
#pragma once

namespace hooke::control {

// The part of the error allowed to a frame at which the controller aims: the estimate is not exact. scripts/tolerance counts the frames
// that exceed what is allowed without a report.
inline constexpr double safety = 0.5;
// Exponents of the proportional-integral controller, times 1 / order: K. Gustafsson, ACM Trans. Math. Softw. 17 (1991) 533-554.
inline constexpr double integral_gain = 0.7, proportional_gain = 0.4;
// The most by which a rejected frame is refined at once: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, IV.2, use 5
// to 10.
inline constexpr int max_growth = 8;
// Rejections in one frame after which methods are compared again.
inline constexpr int max_rejections = 3;
// Where stability sets the step and the error is below this part of what is aimed at, up to so many frames are not estimated: an error that
// doubles from frame to frame stays below it.
inline constexpr double calm_ratio = 0.02;
inline constexpr int max_unestimated = 3;
// [rad], or relative length: such a frame is estimated nevertheless if any spring may turn or change its length by more within it.
inline constexpr double max_turn = 0.25;
// [ms], and relative to the frame before: a frame that would cost more ends with the error that it has, and a report.
inline constexpr double max_cost = 1000.0, max_cost_factor = 30.0;

// [ms], below which the frame before counts as this long.
inline constexpr double short_frame = 0.05;
// The runs of an estimate together cost this much of the last one, with half of its substeps in the one before.
inline constexpr double cost_of_estimate = 1.5;
// When methods are compared, one that misses the share gets the substeps that its order requires, times this margin: at least and at most
// by these factors, and by the last one if its runs do not agree.
inline constexpr double trial_margin = 1.1, min_trial_growth = 1.5, max_trial_growth = 1e3, growth_on_failure = 4.0;

}  // namespace hooke::control
