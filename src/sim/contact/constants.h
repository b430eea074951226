// The constants of contact that change results. Those without a unit are dimensionless.
#pragma once

namespace hooke::contact {

// Gauss-Seidel sweeps over the contacts of surfaces in a substep, forward and backward in turn. They continue from the impulses of the last
// substep. The first substep of a frame has none to continue from. Two sweeps are enough for folds of 33 x 33 points.
inline constexpr int sweeps = 2, first_sweeps = 16;
// Contact examines features up to this part of the thickness beyond the thickness, because others may push them together.
inline constexpr double slack = 0.1;
// Overlaps are removed with at most this frequency, per substep. (E. Catto, Box2D v3, b2MakeSoft and contactHertz: a quarter)
inline constexpr double max_frequency = 0.25;
// Features closer than this part of the thickness have no contact, because they have no direction from one to the other.
inline constexpr double coincident = 1e-8;
// Additive continuous collision detection: each step goes this part of the safe way, and the search ends at `ccd_min_part` of the first
// distance. (M. Li, D. Kaufman, C. Jiang, Codimensional IPC, 2021, algorithm 1)
inline constexpr double ccd_safety = 0.9, ccd_min_part = 0.1;
// Passes of continuous collision detection with impacts. In later passes, what meets moves together.
inline constexpr int impact_passes = 6;
// A spring or face near a nail is a lever: what the hand moves may move its points at most this many times as fast.
inline constexpr double max_leverage = 8.0;
// Rest begins below this multiple of the speed that the accelerations supply in a substep.
inline constexpr double rest_speed = 2.0;
// Speeds of approach below this part of the speed that the accelerations supply in a substep count as zero.
inline constexpr double quiet_part = 1e-3;
// Gauss-Seidel sweeps over points that touch each other. They end earlier if no velocity changes by more than a tolerance.
inline constexpr int max_sweeps = 200;
// Impacts of each path in a substep. Further impacts have no restitution, and after twice as many, none follow.
inline constexpr long max_impacts = 64;
// [rad] The path along a ball is of second order if it turns by at most this angle in a substep.
inline constexpr double max_arc = 0.125;

// [m] A sticky one-way wall holds points at rest within this distance: half a pixel of XSpringies.
inline constexpr double held_distance = 0.005;

}  // namespace hooke::contact
