// Error of a frame, estimated by repeating it with half the step.
#pragma once

#include "sim/model/settings.h"
#include "sim/model/state.h"
#include "sim/model/system.h"
#include "sim/plan/plan.h"

namespace hooke {

struct FrameError {
  double rms = 0.0, max = 0.0;  // [m], over the points that are not nailed
};

// The settings of the repetition: half the step; for a method that adapts its step a thousandth of the tolerance, with contact a tenth, and
// with contact of faces or springs, or a strain limit, half of the longest step and 2^-8 of the tolerance; for `auto` a tenth. Where
// springs break, up to a substep too late whatever the method, they do so in time: with half the step they may break at the same time by
// chance.
Settings refined(const System& system, const Settings& settings);

// The order of the positions on this scene: the lowest of those that apply to what it contains.
int effective_order(const System& system, const Integrator& method);
// The same while nothing touches.
int free_order(const System& system, const Integrator& method);

// Factor from the difference to the repetition to the error: 2^p / (2^p - 1) for a method of order p (Richardson), or 1 where the
// repetition is exact in comparison.
double refinement_weight(const System& system, const Settings& settings);

// How a frame is repeated to measure its error: the settings, and the factor from the difference to the error. Usually by half the step. A
// method that dissipates vibrations faster than its step (h omega > 1) does so with half the step too, and both agree on what they lost: by
// explicit steps that resolve them, where these cost no more than twice the frame, or 2 ms, by the model of the cost.
struct Repetition {
  Settings settings;
  double weight = 1.0;
  bool is_resolving = false;
};
Repetition repetition_of(const Plan& plan, const System& system, const Settings& settings);

// Whether the steps with which a frame was computed (settings_used) are short enough for the oscillations of colliders and muscles. If not,
// half the step may miss the same parts of them. A method that adapts its step takes shorter ones.
bool resolves_oscillations(const Plan& plan, const Settings& used);

// `weight` times the distance between the positions of two states of the scene, over the points that are not nailed: nails, which have no
// error, must not dilute that of the others.
FrameError weighted_distance(const System& system, const std::vector<Vec3>& first, const std::vector<Vec3>& second, double weight);

// The error that the method of `settings` makes in the one frame that follows `state`: RMS over the points that are not nailed [m]. Costs
// three frames, and allocates. With `auto`, of the method and substeps that it chooses for that frame.
double estimate_frame_error(const System& system, const Settings& settings, const State& state);

}  // namespace hooke
