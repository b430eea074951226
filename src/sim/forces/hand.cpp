#include "sim/forces/hand.h"

#include <glm/geometric.hpp>

#include "sim/forces/motion.h"

namespace hooke {
namespace {

// The component c of every point.
const double* component(const Plan& plan, const Field& field, int c) { return field.data() + static_cast<std::size_t>(c) * plan.points; }

}  // namespace

Vec3 hand_force(const Plan& plan, const Motion& motion) {
  Vec3 force(0.0);
  if (plan.hand.pull) {
    const Vec3 target = plan.hand.pull->target_at(motion.time);
    for (int c = 0; c < plan.dimensions; ++c)
      force[c] = plan.hand.pull->stiffness * (target[c] - plan.hand.pull->interpolate(component(plan, motion.x, c)));
  }
  if (!plan.hand.held) return force;

  // the opposite of the spring forces -(k (l - l0) + d l') u, u from the other end, and of m g
  const Vec3 x = vector_at(plan, motion.x, *plan.hand.held), v = vector_at(plan, motion.v, *plan.hand.held);
  force = -plan.hand.held_mass * plan.gravity;
  for (const auto& [s, other] : plan.hand.held_springs) {
    const Vec3 along = x - vector_at(plan, motion.x, other);
    const double length = glm::length(along);
    if (length == 0.0) continue;
    const double stretching = glm::dot(v - vector_at(plan, motion.v, other), along) / length;
    const double damping = plan.has_dashpots() ? plan.spring.damping[s] : 0.0;
    force += (plan.spring.stiffness[s] * (length - plan.spring.rest_length[s]) + damping * stretching) / length * along;
  }
  return force;
}

double energy_of_hand_alone(const Plan& plan, const Motion& motion) {
  double energy = 0.0;
  if (!plan.hand.held) return energy;
  for (const auto& [s, other] : plan.hand.held_springs) {
    if (plan.inverse_mass[other] != 0.0) continue;
    const double stretch =
        glm::distance(vector_at(plan, motion.x, *plan.hand.held), vector_at(plan, motion.x, other)) - plan.spring.rest_length[s];
    energy += 0.5 * plan.spring.stiffness[s] * stretch * stretch;
  }
  return energy;
}

double hand_power(const Plan& plan, const Motion& motion) {
  if (!plan.hand.held && !plan.hand.pull) return 0.0;
  Vec3 force = hand_force(plan, motion);
  if (!plan.hand.held) return glm::dot(force, plan.hand.pull->velocity);
  for (const auto& [s, other] : plan.hand.held_springs) {
    const Vec3 along = vector_at(plan, motion.x, *plan.hand.held) - vector_at(plan, motion.x, other);
    const double length = glm::length(along);
    if (plan.inverse_mass[other] == 0.0 && length > 0.0)
      force -= plan.spring.stiffness[s] * (length - plan.spring.rest_length[s]) / length * along;
  }
  return glm::dot(force, vector_at(plan, motion.v, *plan.hand.held));
}

}  // namespace hooke
