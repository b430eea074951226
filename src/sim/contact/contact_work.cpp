#include "sim/contact/contact_work.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/energy/plan_energy.h"

namespace hooke {

double book_contact_work(double work, const SuppliedWork& bounds, Motion& motion) {
  const double by_hand = std::clamp(work, -bounds.by_hand, bounds.by_hand);
  const double by_colliders = std::clamp(work - by_hand, -bounds.by_colliders, bounds.by_colliders);
  motion.hand_work += by_hand;
  motion.abs_hand_work += std::abs(by_hand);
  motion.collider_work += by_colliders;
  const double rest = work - by_hand - by_colliders;
  motion.contact_work += rest;
  return rest;
}

double canceled_work(double first, double second) {
  return first * second < 0.0 ? std::copysign(std::min(std::abs(first), std::abs(second)), first) : 0.0;
}

double kinetic_energy(const Plan& plan, const Field& v) {
  double energy = 0.0;
  for (int c = 0; c < plan.dimensions; ++c)
    for (std::size_t i = 0, at = static_cast<std::size_t>(c) * plan.points; i < static_cast<std::size_t>(plan.points); ++i, ++at)
      if (plan.inverse_mass[i] != 0.0) energy += 0.5 * plan.mass[i] * v[at] * v[at];
  return energy;
}

double potential_energy(const Plan& plan, double time, const Field& x) {
  double energy = stored_energy(plan, x);
  for (const Force& force : plan.forces)
    if (force.term->potential != nullptr) energy += force.term->potential(plan, force.values, time, x.data());
  return energy;
}

double mechanical_energy(const Plan& plan, double time, const Motion& motion) {
  return kinetic_energy(plan, motion.v) + potential_energy(plan, time, motion.x);
}

double held_speed(const Plan& plan, const Motion& motion) {
  if (!plan.hand.held) return 0.0;
  double sum = 0.0;
  for (int c = 0; c < plan.dimensions; ++c) {
    const double v = motion.v[static_cast<std::size_t>(c) * plan.points + *plan.hand.held];
    sum += v * v;
  }
  return std::sqrt(sum);
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
