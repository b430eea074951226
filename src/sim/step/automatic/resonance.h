// Steps of blanes_moan4 beyond its resonance. Modes with h omega from 3.163 to 3.169 grow, without drag by up to a factor of e^0.0024 a
// step; beyond, up to 5.02, none grows. Such a mode starts at the size of rounding errors and grows so slowly that an estimate of the error
// of a frame notices it while its error is within the tolerance, if the estimates are frequent enough; then the substeps, and with them the
// resonance, change.
#pragma once

#include "sim/plan/plan.h"

namespace hooke {

struct Integrator;

// Whether such steps may be used: the scene consists of springs without dashpots, and of drag; and a mode with an error of `target` [m] is
// slow in comparison with the scene, whose points move at `speed` [m/s], so that its energy is small too.
bool may_step_beyond_resonance(const Plan& plan, double target, double speed);

// The fewest substeps if they may be used: `stable`, those with which no mode grows, or, for blanes_moan4, fewer, where these are so few
// that the error need not be estimated more often than every 5th frame. `frequency`: of the fastest mode relative to the spectrum of the
// plan.
int substeps_beyond_resonance(const Integrator& method, const Spectrum& spectrum, double frame_rate, double frequency, int stable);

// Frames within which a mode in resonance grows by a factor of at most e^2; the maximum of int if there is none.
int max_frames_in_resonance(const Integrator& method, const Spectrum& spectrum, double frame_rate, double frequency, int substeps);

}  // namespace hooke
