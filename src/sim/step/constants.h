// Numbers of the step module that change results.
#pragma once

namespace hooke {

// Steps of methods that choose their own.

// Force evaluations in a frame, with those of rejected steps. They take some seconds in a small scene; then the user is told why.
inline constexpr long max_adaptive_evaluations = 2'000'000;
// The same for steps with contact of faces or springs, each of which costs as much as hundreds of force evaluations.
inline constexpr long max_adaptive_surface_steps = 5'000;
// [1] The shortest step of a method, as a part of a substep. Shorter steps are lost in the rounding of the time.
inline constexpr double min_step_fraction = 1e-9;
// [m], [m/s]: contact is resolved to about 1e-13 of the coordinates, and the velocity after an impact to that over its duration.
inline constexpr double contact_round_off = 1e-12, contact_velocity_round_off = 1e-11;
// [1] A step with an impact is divided until no piece has more than this part of the time after the impact: half, with a margin for
// rounding. After `max_splits`, impacts follow each other faster than halving resolves.
inline constexpr double max_piece = 0.55;
inline constexpr int max_splits = 8;
// [1], by which the step follows the error of contact, of third order (E. Hairer, S. Norsett, G. Wanner, Solving Ordinary Differential
// Equations I, II.4: 0.9 and factors within 0.1 and a few times).
inline constexpr double contact_step_safety = 0.9, min_contact_step_factor = 0.1, max_contact_step_factor = 2.0;
// Attempts to end a step just before an impact. Each locates the impact by a shorter step than the last one. The step ends
// `gap_before_impact` [1] of the resolving step before the impact, so that the impact is in the first half of the next step.
inline constexpr int max_attempts_before_impact = 4;
inline constexpr double gap_before_impact = 0.25;

// Springs that are about to break, where their breaks are located within a substep.

// A method that chooses its step looks for breaks within this angle [rad] of the fastest vibration. A spring may break too late by this
// part of a substep [1].
inline constexpr double max_angle_to_break = 0.25, min_part_to_break = 1.0 / 64.0;

// Substeps that are computed at once. This changes results by rounding alone.
inline constexpr int max_at_once = 64;

// Divergence.

// [1] The energy may exceed what was supplied by this factor times its magnitude. No method that works gains as much
// (docs/evidence/stability.md).
inline constexpr double divergence_factor = 100.0;
// [1] A gain must be at least this fraction of the kinetic and elastic energy. In a long fall these far exceed what was supplied, and so
// does a small relative error.
inline constexpr double divergence_fraction = 0.5;
// [1] The minimum energy that counts as supplied, relative to sum k l0^2: springs at rest have rounding errors of this order. Where only
// listed forces act, relative to M (w L)^2, because rounding moves points that are at rest in the center of a force.
inline constexpr double min_elastic_scale = 1e-9, min_force_scale = 1e-20;
// [s] At the start, listed forces may accelerate points for this time before they have done any work: six frames at 60 per second.
inline constexpr double max_start_time = 0.1;
// [1] A point is examined if it is this many times farther away than the supplied energy can move it: far beyond any motion.
inline constexpr double implausible_factor = 1000.0;

// [1] The time at the end of a frame is made a multiple of the duration of a frame if it differs by at most this part of it.
inline constexpr double frame_time_tolerance = 1e-6;

}  // namespace hooke
