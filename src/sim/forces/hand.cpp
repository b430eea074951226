#include "sim/forces/hand.h"

#include <glm/geometric.hpp>

#include "sim/forces/motion.h"

namespace hooke {
namespace {

// The component c of every point.
const double* component(const Plan& plan, const Field& field, int c) { return field.data() + static_cast<std::size_t>(c) * plan.points; }

Vec3 vector_at(const Plan& plan, const Field& field, Index point) {
  Vec3 vector(0.0);
  for (int c = 0; c < plan.dimensions; ++c) vector[c] = component(plan, field, c)[point];
  return vector;
}

}  // namespace

Vec3 hand_force(const Plan& plan, const Motion& motion) {
  Vec3 force(0.0);
  if (plan.pull) {
    const Vec3 target = plan.pull->target_at(motion.time);
    for (int c = 0; c < plan.dimensions; ++c)
      force[c] = plan.pull->stiffness * (target[c] - plan.pull->interpolate(component(plan, motion.x, c)));
  }
  if (!plan.held) return force;

  // the opposite of the spring forces -(k (l - l0) + d l') u, u from the other end, and of m g
  const Vec3 x = vector_at(plan, motion.x, *plan.held), v = vector_at(plan, motion.v, *plan.held);
  force = -plan.held_mass * plan.gravity;
  for (const auto& [s, other] : plan.held_springs) {
    const Vec3 along = x - vector_at(plan, motion.x, other);
    const double length = glm::length(along);
    if (length == 0.0) continue;
    const double stretching = glm::dot(v - vector_at(plan, motion.v, other), along) / length;
    const double damping = plan.has_dashpots() ? plan.damping[s] : 0.0;
    force += (plan.stiffness[s] * (length - plan.rest_length[s]) + damping * stretching) / length * along;
  }
  return force;
}

double energy_of_hand_alone(const Plan& plan, const Motion& motion) {
  double energy = 0.0;
  if (!plan.held) return energy;
  for (const auto& [s, other] : plan.held_springs) {
    if (plan.inverse_mass[other] != 0.0) continue;
    const double stretch = glm::distance(vector_at(plan, motion.x, *plan.held), vector_at(plan, motion.x, other)) - plan.rest_length[s];
    energy += 0.5 * plan.stiffness[s] * stretch * stretch;
  }
  return energy;
}

double hand_power(const Plan& plan, const Motion& motion) {
  if (!plan.held && !plan.pull) return 0.0;
  Vec3 force = hand_force(plan, motion);
  if (!plan.held) return glm::dot(force, plan.pull->velocity);
  for (const auto& [s, other] : plan.held_springs) {
    const Vec3 along = vector_at(plan, motion.x, *plan.held) - vector_at(plan, motion.x, other);
    const double length = glm::length(along);
    if (plan.inverse_mass[other] == 0.0 && length > 0.0) force -= plan.stiffness[s] * (length - plan.rest_length[s]) / length * along;
  }
  return glm::dot(force, vector_at(plan, motion.v, *plan.held));
}

void HandWork::add(const Plan& plan, Motion& motion, double h) const {
  if (!plan.held && !plan.pull) return;
  const double stored = energy_of_hand_alone(plan, motion) - stored_;
  motion.energy.add(EnergyCause::Hand, 0.5 * h * (power_ + hand_power(plan, motion)) + stored);
}

}  // namespace hooke
