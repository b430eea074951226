#include "sim/contact/obstacle.h"

#include <glm/geometric.hpp>
#include <limits>

#include "sim/contact/gap.h"

namespace hooke {

Vec3 without_rounding(const Vec3& correction, const Vec3& x, double h) {
  constexpr double units = 4.0;
  const double rounding = units * std::numeric_limits<double>::epsilon() * glm::length(x) / h;
  return glm::length(correction) <= rounding ? Vec3(0.0) : correction;
}

std::span<const Obstacle> find_obstacles(const Plan& plan, double start, double h, std::vector<Obstacle>& obstacles) {
  obstacles.resize(plan.colliders.size());
  for (std::size_t c = 0; c < obstacles.size(); ++c) {
    Obstacle& obstacle = obstacles[c] = {.collider = &plan.colliders[c]};
    if (!plan.collider_paths.any_moves) continue;
    const Vec3 end = plan.offset_of(c, start + h), last = plan.velocity_of(c, start + h);
    obstacle.offset = plan.offset_of(c, start);
    obstacle.velocity = plan.velocity_of(c, start);
    obstacle.acceleration = (last - obstacle.velocity) / h;
    const Vec3 correction = (end - obstacle.offset) / h - obstacle.velocity - 0.5 * h * obstacle.acceleration;
    obstacle.velocity_correction = without_rounding(correction, obstacle.offset, h);
  }
  return obstacles;
}

Vec3 relative_surface_velocity(const Obstacle& obstacle, const Vec3& normal, const Vec3& x) {
  const ColliderPath& path = obstacle.collider->path;
  Vec3 velocity = tangential(normal, path.belt);
  if (const auto* sphere = std::get_if<Sphere>(&obstacle.collider->shape)) velocity += glm::cross(path.spin, x - sphere->center);
  if (const auto* plane = std::get_if<Plane>(&obstacle.collider->shape)) velocity += glm::cross(path.spin, x - plane->point);
  return velocity;
}

double max_surface_speed(const Obstacle& obstacle, const Vec3& x, double h) {
  const ColliderPath& path = obstacle.collider->path;
  const double shape = std::max(glm::length(obstacle.velocity_at(0.0)), glm::length(obstacle.velocity_at(h)));
  // the surface turns about the anchor of the shape
  const double spin =
      path.spin == Vec3(0.0) ? 0.0 : glm::length(path.spin) * glm::length(x - obstacle.offset - anchor_of(*obstacle.collider));
  return shape + glm::length(obstacle.velocity_correction) + glm::length(path.belt) + spin;
}

}  // namespace hooke
