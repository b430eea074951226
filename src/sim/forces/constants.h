// The numbers of this module that change results. Orders of sums are in the kernels.
#pragma once

#include "base/types.h"

namespace hooke {

// [m], of the positions in a step, of methods that adapt it.
inline constexpr double default_tolerance = 1e-8;

// [m^2], of the ends of a dashpot: shorter springs have no well-defined direction, and the factor of the impulse may overflow.
inline constexpr double min_dashpot_length_squared = 1e-280;
// [springs], from which a net is swept in two halves, on two threads if there are any, and [springs] for each spring from one half to the
// other: with more of them, the halves would wait for the rest.
inline constexpr Index min_springs_of_halves = 16'000, min_springs_per_crossing = 20;

// The strain limit: rounds over all springs (X. Provot 1995 uses a few), the part of its limit by which a spring may be too long at their
// end [1], and the ratio to it up to which shortening conserves angular momentum [1]: a spring that is longer was not shortened before, and
// its ends would be accelerated in every round.
inline constexpr int max_limit_rounds = 16;
inline constexpr double limit_tolerance = 1e-9, max_conserving_ratio = 1.01;

// The power of listed forces, drag and dashpots is integrated by Simpson's rule up to this rate times the step [1] and this second
// difference, relative to the power [1]. With a larger product the rule yields more than implicit methods dissipate, by a fraction of (rate
// h)^2 / 12, which would appear as a gain; points faster than the air have higher rates than the estimate, and then the power changes by
// more than a part of itself.
inline constexpr double max_resolved_rate = 0.3, max_power_bend = 0.2;

// [1], of the energy of its motion far away, by which a force may change that of a point within a step without being resolved.
inline constexpr double max_unresolved_change = 0.01;

// [1], of its full volume, below which the pressure of an enclosure does not increase further: it is finite at volume zero.
inline constexpr double min_volume_ratio = 0.05;
// [1], of its full volume, that an enclosure of the estimate of stiffness has at least.
inline constexpr double estimated_volume_ratio = 2.0 / 3.0;

// Sticky planes. [m], within which a point counts as touching, and [m/s], the speed away from the plane at which it is not at rest on it,
// and of the velocities [1]: contact places resting points on the surface to round-off. [m], [m/s], round-off itself.
inline constexpr double sticky_distance = 1e-9, sticky_speed = 1e-9, sticky_round_off = 1e-13;

// [1], the perimeter of an isosceles right triangle, relative to its short sides: faces of the estimate of the stiffness of wind.
inline constexpr double perimeter_of_face = 3.4;
// [cells], of a row of quads from which vectors pay.
inline constexpr Index min_face_cells = 4;

}  // namespace hooke
