// Compares the methods on the coming frame and selects the cheapest one that meets the tolerance.
#pragma once

#include "sim/model/state.h"
#include "sim/step/automatic/trials.h"

namespace hooke {

// An error of up to this multiple of the target is still within the tolerance.
inline constexpr double acceptable_ratio = 2.0;
// After it, the substeps are raised to this part of the target.
inline constexpr double raised_ratio = 0.8;

// What a choice has to achieve.
struct Goal {
  double target = 0.0;     // [m], error of a frame
  double max_cost = 0.0;   // [ms], of a frame
  double frequency = 1.0;  // [1], bound on the frequencies in this state, relative to that of the plan
};

// [ms], of a frame, beyond which accuracy is given up: the budget, or without one a multiple of the cheapest stable method.
double max_cost_of_frame(Trials& trials, const Plan& plan, const Settings& settings);

// The number of substeps expected to reduce an error to the target, with a method of this order; at most `max_factor` as many.
int substeps_for(int substeps, double error, double target, int order, double max_factor);

// The order with which the method is expected to converge on this scene, from steps of this length [s] on.
int optimistic_order(const Plan& plan, const System& system, const Integrator& method, double step);

// The substeps of the next frame after one whose error is `ratio` times the target, more than 1 and acceptable. Temporary: methods are
// compared again after a few frames, because a cheaper one almost met the goal.
int raised_substeps(const Plan& plan, const System& system, const Settings& settings, double ratio, bool is_temporary);

// What is known about the present choice when methods are compared: nothing, or its error and cost on this frame.
enum class Present { ToBeMeasured, Known };

// The best choice for the frame that `trials` begins with: method, substeps, ratio and cost. A method must be clearly cheaper than that of
// `present`, which may be null, to take its place; its substeps are tried first. Where none meets the goal, the one with the smallest
// error. The frame of the choice is kept. `until_selection` of the choice is positive where a much cheaper method almost met the goal: the
// frames until another comparison.
MethodChoice select_method(Trials& trials, const Plan& plan, const System& system, const Settings& settings, const Goal& goal,
                           const MethodChoice* present, Present knowledge);

}  // namespace hooke
