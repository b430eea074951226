// Numbers of the forces module that change results.
#pragma once

namespace hooke {

// [1], rate of a power times the step, up to which Simpson's rule along the cubic through both ends integrates it: with a larger product it
// yields more than implicit methods dissipate, by a fraction of (rate h)^2 / 12, less than 1 % here.
inline constexpr double max_resolved_rate = 0.3;
// [1], second difference of the power over a step relative to its maximum: with a larger one the step does not resolve the power. Half of
// what a power has that rises in proportion to the time from the middle of the step on.
inline constexpr double max_power_bend = 0.2;

}  // namespace hooke
