// Numbers of the step module that change results.
#pragma once

namespace hooke {

// Steps of methods that choose their own.

// Force evaluations in a frame, those of rejected steps included: some seconds of a small scene, after which a user should know why.
inline constexpr long max_adaptive_evaluations = 2'000'000;
// The same for steps with contact of faces or springs, each of which costs as much as hundreds of force evaluations.
inline constexpr long max_adaptive_surface_steps = 5'000;
// [1], of a substep: the shortest step of a method. Shorter ones are rounded away in the time.
inline constexpr double min_step_fraction = 1e-9;
// [m], [m/s]: contact is resolved to about 1e-13 of the coordinates, and the velocity after an impact to that over its duration.
inline constexpr double contact_round_off = 1e-12, contact_velocity_round_off = 1e-11;
// [1], the part of the time after an impact in a step that a piece of it may contain: half, and some margin for rounding; and into how many
// pieces a step is divided for that, after which impacts follow each other faster than halving resolves.
inline constexpr double max_piece = 0.55;
inline constexpr int max_splits = 8;
// [1], by which the step follows the error of contact, of third order (E. Hairer, S. Norsett, G. Wanner, Solving Ordinary Differential
// Equations I, II.4: 0.9 and factors within 0.1 and a few times).
inline constexpr double contact_step_safety = 0.9, min_contact_step_factor = 0.1, max_contact_step_factor = 2.0;
// Attempts to end a step just before an impact, each with the impact located by a shorter step than before; and where it ends [1], before
// the impact, of the step that resolves it, so that the impact is in the first half of the next one.
inline constexpr int max_attempts_before_impact = 4;
inline constexpr double gap_before_impact = 0.25;

// Springs that are about to break, where their breaks are located within a substep.

// [rad], of the fastest vibration, in which a method that chooses its step looks for breaks; and the part of a substep [1] by which a
// spring may break too late.
inline constexpr double max_angle_to_break = 0.25, min_part_to_break = 1.0 / 64.0;

// Substeps at once, which change results by rounding alone.
inline constexpr int max_at_once = 64;

// Divergence.

// [1], the energy may exceed what was supplied by this factor times its magnitude: no method that works gains as much
// (docs/evidence/stability.md).
inline constexpr double divergence_factor = 100.0;
// [1], and a gain must be at least this fraction of the kinetic and elastic energy: in a long fall these exceed what was supplied by far,
// and so does a small relative error.
inline constexpr double divergence_fraction = 0.5;
// [1], the least energy that counts as supplied, of sum k l0^2: springs at rest have rounding errors of this order. And of M (w L)^2 where
// only listed forces act, because rounding moves points that are at rest in the center of a force.
inline constexpr double min_elastic_scale = 1e-9, min_force_scale = 1e-20;
// [s], for which listed forces may accelerate points at the start before they have done any work: six frames at 60 per second.
inline constexpr double max_start_time = 0.1;
// [1], a point this many times farther away than what was supplied reaches is examined: far beyond any motion, near enough for doubles.
inline constexpr double implausible_factor = 1000.0;

// [1], of a frame: the time at its end is a multiple of the duration of a frame if it is one up to this.
inline constexpr double frame_time_tolerance = 1e-6;

}  // namespace hooke
