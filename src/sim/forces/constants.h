// The numbers of this module that change results. Orders of sums are in the kernels.
#pragma once

#include "base/types.h"

namespace hooke {

// [m] Error of the positions in a step, for methods that adapt the step.
inline constexpr double default_tolerance = 1e-8;

// [m^2] Shorter dashpots do not act: they have no well-defined direction, and the factor of the impulse may overflow.
inline constexpr double min_dashpot_length_squared = 1e-280;

// The strain limit: rounds over all springs (X. Provot 1995 uses a few). At their end, a spring may exceed its limit by `limit_tolerance`
// [1]. Up to `max_conserving_ratio` [1] times the limit, shortening conserves angular momentum. In a longer spring, this would accelerate
// the ends in every round.
inline constexpr int max_limit_rounds = 16;
inline constexpr double limit_tolerance = 1e-9, max_conserving_ratio = 1.01;

// The power of listed forces, drag and dashpots is integrated by Simpson's rule up to this rate times the step [1], and up to
// `max_power_bend` [1], its second difference relative to itself. At higher rates the rule yields more than implicit methods dissipate, by
// a fraction of (rate h)^2 / 12, which would appear as a gain. The second bound is for points faster than the air, whose rates exceed the
// estimate.
inline constexpr double max_resolved_rate = 0.3, max_power_bend = 0.2;

// [1] A force need not be resolved if it changes the energy of a point by at most this part within a step.
inline constexpr double max_unresolved_change = 0.01;

// [1] Below this part of its full volume, the pressure of an enclosure does not increase further. So it is finite at volume zero.
inline constexpr double min_volume_ratio = 0.05;
// [1] The estimate of the stiffness of an enclosure assumes at least this part of its full volume.
inline constexpr double estimated_volume_ratio = 2.0 / 3.0;

// Sticky planes. [m], within which a point counts as touching, and [m/s], the speed away from the plane at which it is not at rest on it,
// and of the velocities [1]: contact places resting points on the surface to round-off. [m], [m/s], round-off itself.
inline constexpr double sticky_distance = 1e-9, sticky_speed = 1e-9, sticky_round_off = 1e-13;

// [1] Perimeter of an isosceles right triangle, relative to its short sides, for the estimate of the stiffness of wind.
inline constexpr double perimeter_of_face = 3.4;
// [cells] From this length of a row of quads on, vector instructions pay.
inline constexpr Index min_face_cells = 4;

}  // namespace hooke
