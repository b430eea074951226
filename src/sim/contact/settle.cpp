#include "sim/contact/settle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hooke {
namespace {

void apply(const Touch& touch, const Vec3& impulse, std::span<const PointPath> paths, std::span<Vec3> v) {
  v[touch.first] += paths[touch.first].inverse_mass * impulse;
  if (touch.second != no_path) v[touch.second] -= paths[touch.second].inverse_mass * impulse;
}

Vec3 relative_velocity(const Touch& touch, std::span<const Vec3> v) {
  return v[touch.first] - (touch.second != no_path ? v[touch.second] : touch.surface);
}

// The normal impulse, then friction within its cone. Returns the larger change of the relative velocity [m/s].
double relax(Touch& touch, std::span<const PointPath> paths, std::span<Vec3> v) {
  const double weight = paths[touch.first].inverse_mass + (touch.second != no_path ? paths[touch.second].inverse_mass : 0.0);
  if (weight == 0.0) return 0.0;
  const double normal_velocity = glm::dot(touch.normal, relative_velocity(touch, v));
  const double normal_impulse = std::max(0.0, touch.normal_impulse + (touch.min_velocity - normal_velocity) / weight);
  const double normal_change = normal_impulse - touch.normal_impulse;
  touch.normal_impulse = normal_impulse;
  if (normal_change != 0.0) apply(touch, normal_change * touch.normal, paths, v);
  if (touch.friction == 0.0 || (normal_impulse == 0.0 && touch.friction_impulse == Vec3(0.0))) return weight * std::abs(normal_change);

  const Vec3 velocity = relative_velocity(touch, v);
  Vec3 friction = touch.friction_impulse - (velocity - glm::dot(touch.normal, velocity) * touch.normal) / weight;
  const double size = glm::length(friction), max = touch.friction * normal_impulse;
  if (size > max) friction *= max / size;
  const Vec3 friction_change = friction - touch.friction_impulse;
  touch.friction_impulse = friction;
  apply(touch, friction_change, paths, v);
  return weight * std::max(std::abs(normal_change), glm::length(friction_change));
}

}  // namespace

long settle(std::span<Touch> touches, std::span<const std::size_t> active, std::span<const PointPath> paths, double tolerance,
            std::span<Vec3> v) {
  for (const std::size_t t : active) {
    const Touch& touch = touches[t];
    if (touch.normal_impulse > 0.0) apply(touch, touch.normal_impulse * touch.normal + touch.friction_impulse, paths, v);
  }
  long impulses = 0;
  for (int sweep = 0; sweep < max_settle_sweeps; ++sweep) {
    double change = 0.0;
    impulses += static_cast<long>(active.size());
    for (std::size_t k = 0; k < active.size(); ++k)
      change = std::max(change, relax(touches[active[sweep % 2 == 0 ? k : active.size() - 1 - k]], paths, v));
    if (!(change > tolerance)) break;
  }
  return impulses;
}

}  // namespace hooke
