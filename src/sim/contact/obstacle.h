// Colliders during a step.
#pragma once

#include <span>
#include <vector>

#include "sim/plan/plan.h"

namespace hooke {

// A collider during a step, and the displacement of its shape: on the parabola through both ends with its mean acceleration, whose
// initial velocity differs from the true one by `velocity_correction`. All zero for a collider at rest.
struct Obstacle {
  const Collider* collider = nullptr;
  Vec3 offset{0.0}, velocity{0.0}, acceleration{0.0}, velocity_correction{0.0};
  Vec3 offset_at(double t) const { return offset + t * (velocity + velocity_correction + 0.5 * t * acceleration); }
  Vec3 velocity_at(double t) const { return velocity + t * acceleration; }
};

inline bool moves(const Obstacle& obstacle) { return obstacle.velocity != Vec3(0.0) || obstacle.acceleration != Vec3(0.0); }

// The plan's colliders in the step of h that starts at `start`.
std::span<const Obstacle> find_obstacles(const Plan& plan, double start, double h, std::vector<Obstacle>& obstacles);

// The correction [m/s] of a velocity by the difference of two positions about `x`, h [s] apart; zero where it is rounding. Impacts within a
// tight tolerance need steps so short that the difference has lost most of its digits.
Vec3 without_rounding(const Vec3& correction, const Vec3& x, double h);

// [m/s^2], by which drag [1/s] changes in the `left` seconds after a velocity changes: the mean of an exponential decay, to fourth order.
inline Vec3 change_of_drag(double drag, double left, const Vec3& velocity_change) {
  const double x = drag * left;
  return -drag / (1.0 + 0.5 * x + x * x / 12.0) * velocity_change;
}

// The velocity of the surface below a point at x, on the side of `normal`, relative to the shape: of a belt, or of a spin.
Vec3 relative_surface_velocity(const Obstacle& obstacle, const Vec3& normal, const Vec3& x);

// A bound on the speed [m/s] of the surface of an obstacle near x in a substep of h.
double max_surface_speed(const Obstacle& obstacle, const Vec3& x, double h);

}  // namespace hooke
