#include "sim/forces/hand.h"

#include <glm/geometric.hpp>

#include "sim/forces/motion.h"
#include "sim/forces/spring_laws.h"

namespace hooke {

Vec3 hand_force(const Plan& plan, const Motion& motion) {
  Vec3 force(0.0);
  if (plan.hand.pull) force = -plan.hand.pull->stiffness * pull_stretch(plan, motion.x, motion.time);
  if (!plan.hand.held) return force;

  // the opposite of the spring forces -(k (l - l0) + d l') u, u from the other end, and of m g
  const Vec3 x = vector_at(plan, motion.x, *plan.hand.held), v = vector_at(plan, motion.v, *plan.hand.held);
  force = -plan.hand.held_mass * plan.gravity;
  for (const auto& [s, other] : plan.hand.held_springs) {
    const Vec3 along = x - vector_at(plan, motion.x, other);
    const double length = glm::length(along);
    if (length == 0.0) continue;
    const double stretching = glm::dot(v - vector_at(plan, motion.v, other), along) / length;
    const auto [of, damping] = response_of(plan, s, motion.time, length);
    force += (of.tension + damping * stretching) / length * along;
  }
  return force;
}

namespace {

// The energy [J] of the springs between a held point and points that do not move, with the rest lengths at this time: only the hand changes
// it.
double energy_of_hand_alone(const Plan& plan, double time, const Motion& motion) {
  double energy = 0.0;
  if (!plan.hand.held) return energy;
  for (const auto& [s, other] : plan.hand.held_springs) {
    if (plan.inverse_mass[other] != 0.0) continue;
    const double length = glm::distance(vector_at(plan, motion.x, *plan.hand.held), vector_at(plan, motion.x, other));
    energy += response_of(plan, s, time, length).of.energy;
  }
  return energy;
}

// The power [W] of the force of the hand, without what it does to those.
double hand_power(const Plan& plan, const Motion& motion) {
  if (!plan.hand.held && !plan.hand.pull) return 0.0;
  Vec3 force = hand_force(plan, motion);
  if (!plan.hand.held) return glm::dot(force, plan.hand.pull->velocity);
  for (const auto& [s, other] : plan.hand.held_springs) {
    const Vec3 along = vector_at(plan, motion.x, *plan.hand.held) - vector_at(plan, motion.x, other);
    const double length = glm::length(along);
    if (plan.inverse_mass[other] == 0.0 && length > 0.0) force -= response_of(plan, s, motion.time, length).of.tension / length * along;
  }
  return glm::dot(force, vector_at(plan, motion.v, *plan.hand.held));
}

// The part [W] of it against dashpots.
double power_on_dashpots(const Plan& plan, const Motion& motion) {
  double power = 0.0;
  if (!plan.hand.held) return power;
  const Vec3 x = vector_at(plan, motion.x, *plan.hand.held), v = vector_at(plan, motion.v, *plan.hand.held);
  for (const auto& [s, other] : plan.hand.held_springs) {
    const Vec3 along = x - vector_at(plan, motion.x, other), relative = v - vector_at(plan, motion.v, other);
    const double length = glm::length(along);
    if (length == 0.0) continue;
    const double damping = response_of(plan, s, motion.time, length).damping;
    power += damping * glm::dot(relative, along) * glm::dot(v, along) / (length * length);
  }
  return power;
}

}  // namespace

HandWork::HandWork(const Plan& plan, const Motion& motion)
    : time_(motion.time),
      power_(hand_power(plan, motion)),
      on_dashpots_(power_on_dashpots(plan, motion)),
      stored_(energy_of_hand_alone(plan, motion.time, motion)) {}

void HandWork::add(const Plan& plan, Motion& motion, double h, bool has_swept) const {
  if (!plan.hand.held && !plan.hand.pull) return;
  const double stored = energy_of_hand_alone(plan, time_, motion) - stored_;
  motion.energy.add(EnergyCause::Hand, 0.5 * h * (power_ + hand_power(plan, motion)) + stored);
  if (has_swept) motion.energy.add(EnergyCause::Dashpots, -0.5 * h * (on_dashpots_ + power_on_dashpots(plan, motion)));
}

}  // namespace hooke
