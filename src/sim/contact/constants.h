// The constants of contact that change results. Those without a unit are dimensionless.
#pragma once

namespace hooke::contact {

// Gauss-Seidel sweeps over the contacts of surfaces in a substep, forward and backward in turn, which continue from the impulses of the
// last substep; and those in the first substep of a frame, which starts from none. Two were enough for folds of 33 x 33 points.
inline constexpr int sweeps = 2, first_sweeps = 16;
// How far beyond the thickness, as a part of it, features are examined that others may push towards each other.
inline constexpr double slack = 0.1;
// Overlaps are removed with at most this frequency, per substep. (E. Catto, Box2D v3, b2MakeSoft and contactHertz: a quarter)
inline constexpr double max_frequency = 0.25;
// Features closer than this part of the thickness have no direction from one to the other.
inline constexpr double coincident = 1e-8;
// Additive continuous collision detection: the part of a bound that each of its steps uses, and that of the distance that remains.
// (M. Li, D. Kaufman, C. Jiang, Codimensional IPC, 2021, algorithm 1)
inline constexpr double ccd_safety = 0.9, ccd_min_part = 0.1;
// Passes of continuous collision detection with impacts; in later ones, what meets moves together from then on.
inline constexpr int impact_passes = 6;
// What the hand moves moves the points of springs and faces at most so many times as fast: near a nail, they are levers of any length.
inline constexpr double max_leverage = 8.0;
// What approaches more slowly than this multiple of what the accelerations supply in a substep rests.
inline constexpr double rest_speed = 2.0;
// And below this part of it, speeds of approach count as zero.
inline constexpr double quiet_part = 1e-3;
// Gauss-Seidel sweeps over points that touch each other at most: they end when no velocity changes by more than a tolerance.
inline constexpr int max_sweeps = 200;
// Impacts of each path in a substep, after which they lose their restitution; twice as many, and none follow.
inline constexpr long max_impacts = 64;
// [rad], by which the path along a ball turns in a substep at most, if it is to be of second order.
inline constexpr double max_arc = 0.125;

// [m], half a pixel of XSpringies: the distance from a sticky one-way wall within which a point at rest is held.
inline constexpr double held_distance = 0.005;

}  // namespace hooke::contact
