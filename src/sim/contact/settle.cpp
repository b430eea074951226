#include "sim/contact/settle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hooke {
namespace {

void apply(const Touch& touch, const Vec3& impulse, std::span<const PointPath> paths, std::span<Vec3> v) {
  v[touch.first] += paths[touch.first].inverse_mass * impulse;
  v[touch.second] -= paths[touch.second].inverse_mass * impulse;
}

// The normal impulse, then friction within its cone. Returns the larger change of the relative velocity [m/s].
double relax(Touch& touch, std::span<const PointPath> paths, std::span<Vec3> v) {
  const double weight = paths[touch.first].inverse_mass + paths[touch.second].inverse_mass;
  if (weight == 0.0) return 0.0;
  const Vec3 velocity = v[touch.first] - v[touch.second] - touch.surface;
  const double normal_velocity = glm::dot(touch.normal, velocity);
  const ContactImpulse before = touch.impulse;
  const double normal_impulse = std::max(0.0, before.normal + (touch.min_velocity - normal_velocity) / weight);
  if (normal_impulse == 0.0 && before.normal == 0.0) return 0.0;
  const Vec3 slip = velocity - normal_velocity * touch.normal;
  apply(touch, change_impulse(touch.impulse, normal_impulse, touch.normal, touch.friction, slip, 1.0 / weight), paths, v);
  return weight * std::max(std::abs(normal_impulse - before.normal), glm::length(touch.impulse.friction - before.friction));
}

}  // namespace

long settle(std::span<Touch> touches, std::span<const std::size_t> active, std::span<const PointPath> paths, double tolerance,
            std::span<Vec3> v) {
  for (const std::size_t t : active) {
    const Touch& touch = touches[t];
    if (touch.impulse.normal > 0.0) apply(touch, touch.impulse.normal * touch.normal + touch.impulse.friction, paths, v);
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
