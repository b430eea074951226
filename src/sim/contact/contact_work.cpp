#include "sim/contact/contact_work.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace hooke {

double book_contact_work(double work, const SuppliedWork& bounds, Motion& motion) {
  const double by_hand = std::clamp(work, -bounds.by_hand, bounds.by_hand);
  const double by_colliders = std::clamp(work - by_hand, -bounds.by_colliders, bounds.by_colliders);
  const double rest = work - by_hand - by_colliders;
  motion.energy.add(EnergyCause::Hand, by_hand);
  motion.energy.add(EnergyCause::Colliders, by_colliders);
  motion.energy.add(EnergyCause::Contact, rest);
  return rest;
}

double held_speed(const Plan& plan, const Motion& motion) {
  return plan.hand.held ? glm::length(vector_at(plan, motion.v, *plan.hand.held)) : 0.0;
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
