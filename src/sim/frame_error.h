// Error of a frame, estimated by repeating it with half the step.
#pragma once

#include "sim/settings.h"
#include "sim/state.h"
#include "sim/system.h"

namespace hooke {

struct FrameError {
  double rms = 0.0, max = 0.0;  // [m], over all points
};

// The settings of the repetition: half the step, and for a method that adapts its step a thousandth of the tolerance, or with
// contact a tenth; for `auto` a tenth.
Settings refined(const System& system, const Settings& settings);

// The order of the positions on this scene: the lowest of those that apply to what it contains.
int effective_order(const System& system, const Integrator& method);

// Factor from the difference to the repetition to the error: 2^p / (2^p - 1) for a method of order p (Richardson), or 1 where the
// repetition is exact in comparison. Of the lowest order, where parts of the scene have their own methods.
double refinement_weight(const System& system, const Settings& settings);

// `weight` times the distance between the positions of two states of the same scene.
FrameError weighted_distance(const std::vector<Vec3>& first, const std::vector<Vec3>& second, double weight);

// The error that the method of `settings` makes in the one frame that follows `state`: RMS over the points [m]. Costs three frames, and
// allocates. With `auto`, of the method and substeps that it chooses for that frame.
double estimate_frame_error(const System& system, const Settings& settings, const State& state);

}  // namespace hooke
