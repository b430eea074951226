// The part of SurfaceStep that ends a substep: velocities, energy, and what dashpots transmit.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "sim/contact/closest_kernel.h"
#include "sim/contact/contact_work.h"
#include "sim/contact/surface/surface_step.h"
#include "sim/forces/dashpots/dashpot.h"
#include "sim/forces/forces.h"

namespace hooke {
namespace {

// How often dashpots transmit what contact changes.
constexpr int transmissions = 2;

// use(i, point) for all components of a field.
template <class Use>
void for_components(const Plan& plan, const Use& use) {
  std::size_t i = 0;
  for (int c = 0; c < plan.dimensions; ++c)
    for (Index point = 0; point < plan.points; ++point) use(i++, point);
}

}  // namespace

// From (x1, v1), contact leads to (x1 + d, v1 + c). The angular momentum that this adds, sum m d x v1 + m (x1 + d) x c, is that of each
// impulse J on weights w, sum w a x J: where c = d / h, the arms a are x1 - h v1, which is where the substep starts, x0, for methods with
// x1 = x0 + h v1; and a = -h v1 where c = 0. The impulses act along the line between two points of x0, and those that separate do not along
// the velocity: what remains is made good for where it arises, by the points of the contact.
void SurfaceStep::remove_torques(const Plan& plan, double h, const Motion& motion) {
  const std::size_t n = x_.size();
  arm_.resize(n);
  separating_arm_.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 v1 = point_in(plan, motion.v, plan.surface.points[k]);
    arm_[k] = x_[k] + h * (free_u_[k] - (v1 - last_kick_[k]));
    separating_arm_[k] = -h * (v1 + (u_[k] - free_u_[k]));
  }
  for (const SurfaceContact& contact : contacts_.surface) {
    if (contact.pressing + contact.separating == 0.0) continue;
    const Vec3 arm = contact.pressing * weighted(arm_, contact.points, contact.weight) +
                     contact.separating * weighted(separating_arm_, contact.points, contact.weight);
    remove_angular_momentum(glm::cross(arm, contact.normal), contact.points, end_, inverse_mass_, velocity_);
  }
  for (std::size_t k = 0; k < n; ++k) arm_[k] = x_[k] + h * (separated_[k] + last_kick_[k]) + separating_arm_[k];
  for (const Hit& hit : hits_)
    remove_angular_momentum(glm::cross(weighted(arm_, hit.points, hit.weight), hit.push), hit.points, end_, inverse_mass_, velocity_);
}

// The method has accelerated points in the second half of the substep by the forces where it led them, before contact took them back: what
// stiff springs exert there would remain as a velocity of what is at rest. With the forces where points are now, the substep is a step of
// the method at whose start the impulses act. What separates without a velocity does so after it. Colliders have already dealt with what
// touches them.
void SurfaceStep::repeat_last_kick(const Plan& plan, double h, Motion& motion) {
  const auto n = static_cast<std::size_t>(plan.points);
  all_end_ = motion.x;
  for (std::size_t k = 0; k < x_.size(); ++k)
    if (path_[k] != free_u_[k]) {
      const Vec3 at = x_[k] + h * (u_[k] + (path_[k] - separated_[k]));
      for (int c = 0; c < plan.dimensions; ++c) all_end_[c * n + plan.surface.points[k]] = at[c];
    }
  const auto accelerate = [&](const Field& x, Field& acceleration) {
    acceleration.resize(x.size());
    compute_position_forces(plan, motion.time, x, motion.v, acceleration);
    divide_by_mass(plan, acceleration);
    ++motion.counts.force_evaluations;
  };
  // those of the method contain no dashpots if it sweeps over them
  const bool are_known = motion.acceleration_is_current && plan.forces.empty() && plan.spring.max_length.empty() &&
                         (!plan.has_dashpots() || motion.counts.dashpot_sweeps > 0);
  if (!are_known) accelerate(all_free_end_, free_acceleration_);
  const Field& free_acceleration = are_known ? motion.a : free_acceleration_;
  accelerate(all_end_, kick_);
  for (std::size_t k = 0; k < x_.size(); ++k) last_kick_[k] = 0.5 * h * point_in(plan, free_acceleration, plan.surface.points[k]);
  for (std::size_t i = 0; i < motion.v.size(); ++i) {
    kick_[i] = has_collided_[i] != 0 ? 0.0 : 0.5 * h * (kick_[i] - free_acceleration[i]);
    motion.v[i] += kick_[i];
  }
  damping_->note_last_kick(plan, kick_);
  for (std::size_t k = 0; k < x_.size(); ++k) {
    const Vec3 change = point_in(plan, kick_, plan.surface.points[k]);
    last_kick_[k] += change;
    velocity_[k] += change;
    free_velocity_[k] += change;
  }
}

// What touches, where it is at the end of the substep: there, impulses change velocities alone.
void SurfaceStep::move_contacts() {
  FeatureBlock block;
  std::span<SurfaceContact> left(contacts_.surface);
  while (!left.empty()) {
    const FeaturePair kind = left.front().kind;
    for (block.count = 0;
         block.count < FeatureBlock::capacity && block.count < static_cast<int>(left.size()) && left[block.count].kind == kind;
         ++block.count)
      block.points[block.count] = left[block.count].points;
    find_closest(kind, end_, block);
    for (int i = 0; i < block.count; ++i)
      if (block.distance[i] >= coincident) left[i].move_to(block.closest(i), inverse_mass_);
    left = left.subspan(block.count);
  }
}

// Positions and velocities at the end, and the work of contact in addition to that of the forces.
void SurfaceStep::write(const Plan& plan, const Field& v0, double h, Motion& motion) {
  const auto n = static_cast<std::size_t>(plan.points);
  velocity_.resize(x_.size());
  for (std::size_t k = 0; k < x_.size(); ++k)
    velocity_[k] = point_in(plan, motion.v, plan.surface.points[k]) + (u_[k] - free_u_[k]) + (path_[k] - separated_[k]);
  for (std::size_t k = 0; k < x_.size(); ++k)
    if (path_[k] != free_u_[k]) end_[k] = x_[k] + h * path_[k];
  last_kick_.assign(x_.size(), Vec3(0.0));
  // impacts within the substep do not act at its start, what the hand moves has any energy, and the strain limit acts after the method
  const bool is_driven = std::ranges::any_of(contacts_.surface, [](const SurfaceContact& contact) { return contact.is_driven; });
  if (kicks_last_ && !is_limited_ && hits_.empty() && !is_driven) repeat_last_kick(plan, h, motion);
  // friction causes far larger ones
  if (plan.surface.friction == 0.0) remove_torques(plan, h, motion);
  // what was kept from approaching does not at the end either: the second half of a step of the method accelerates it again
  std::erase_if(contacts_.surface, [](const SurfaceContact& contact) { return !contact.is_pressed; });
  std::erase_if(contacts_.obstacles, [](const ObstacleContact& contact) { return !contact.is_pressed; });
  for (SurfaceContact& contact : contacts_.surface) {
    contact.target = 0.0;
    contact.impulse = {};
  }
  for (ObstacleContact& contact : contacts_.obstacles) {
    contact.target = contact.end_target;
    contact.impulse = contact.end_impulse;
  }
  move_contacts();
  contacts_.settle(inverse_mass_, plan.surface.friction, velocity_);
  rebound(plan);

  // where the strain limit has moved points, contact moves them back, against springs whose force changes on the way
  const double energy = is_limited_ ? mechanical_energy(plan, motion.time, motion) : 0.0;
  double work = 0.0, lag_work = 0.0;
  for (std::size_t k = 0; k < x_.size(); ++k) {
    const Index i = plan.surface.points[k];
    const Vec3 v1 = point_in(plan, motion.v, i);
    if (inverse_mass_[k] == 0.0 || (path_[k] == free_u_[k] && velocity_[k] == v1)) continue;
    const Vec3 supplied = free_velocity_[k] - point_in(plan, v0, i), displacement = end_[k] - point_in(plan, motion.x, i);
    const double kinetic = 0.5 * (glm::dot(velocity_[k], velocity_[k]) - glm::dot(v1, v1));
    work += plan.mass[i] * (kinetic - glm::dot(supplied, displacement) / h);
    lag_work += plan.mass[i] * velocity_lag_ * glm::dot(supplied, velocity_[k] - v1);
    for (int c = 0; c < plan.dimensions; ++c) {
      motion.x[c * n + i] = end_[k][c];
      motion.v[c * n + i] = velocity_[k][c];
    }
  }
  if (is_limited_) work = mechanical_energy(plan, motion.time, motion) - energy;
  book_contact_work(work, supplied_work(plan, motion), motion);
  // impulses act at the velocity that belongs to the position; what the hand and colliders supply is part of the energy of the state
  motion.contact_work += lag_work;
}

// After all impulses of the substep. Impulses on the held point are bounded one by one: near it, they may be far larger than what
// the other points of a feature take of them.
SuppliedWork SurfaceStep::supplied_work(const Plan& plan, const Motion& motion) const {
  SuppliedWork supplied;
  if (plan.hand.held) {
    double impulses = held_impulse_;
    for (const SurfaceContact& contact : contacts_.surface)
      for (int c = 0; c < 4; ++c)
        if (plan.surface.points[contact.points[c]] == plan.hand.held)
          impulses += std::abs(contact.weight[c]) * (contact.pressing + contact.separating + contact.impulse.normal) *
                      (1.0 + plan.surface.friction);
    supplied.by_hand = impulses * held_speed(plan, motion);
  }
  for (const ObstacleContact& contact : contacts_.obstacles)
    supplied.by_colliders += (contact.pressing + contact.impulse.normal) * (1.0 + contact.friction) * glm::length(contact.surface);
  return supplied;
}

// What obstacles have changed since begin_substep. Where points touch each other as well, those near an obstacle count: what points do to
// each other is no reason to leave out forces by which springs act at both of their ends.
void SurfaceStep::note_collisions(const Plan& plan, std::span<const Obstacle> obstacles, double h, const Motion& motion) {
  has_collided_.resize(motion.v.size());
  for (std::size_t i = 0; i < motion.v.size(); ++i) has_collided_[i] = motion.v[i] != all_free_velocity_[i] ? 1 : 0;
  if (!plan.pairs.on) return;
  const auto n = static_cast<std::size_t>(plan.points);
  for (Index point = 0; point < plan.points; ++point) {
    const Vec3 end = point_in(plan, motion.x, point);
    const double reach = h * (glm::length(point_in(plan, motion.v, point)) + glm::length(point_in(plan, all_free_velocity_, point)));
    const auto is_near = [&](const Obstacle& obstacle) {
      const Vec3 position = end - obstacle.offset_at(h);
      return gap_to(*obstacle.collider, plan.radius[point], position).distance <=
             reach + h * glm::length(obstacle.velocity_at(h)) + contact_tolerance(position);
    };
    if (std::ranges::none_of(obstacles, is_near))
      for (int c = 0; c < plan.dimensions; ++c) has_collided_[c * n + point] = 0;
  }
}

// In the substep, dashpots have acted on velocities without contact: at rest, on those that the weight alone would cause. Forces act all
// over the substep, and so do the impulses of contact that balance them: dashpots transmit them, too, for half of it. What restores the
// contacts then is transmitted again.
//
// Methods whose velocity at the end is that of the path are left alone: what contact changes there is the path.
void SurfaceStep::transmit_through_dashpots(const Plan& plan, std::span<const Obstacle> obstacles, const Field& x0, bool touches, double h,
                                            Motion& motion) {
  const std::size_t n = motion.v.size();
  const auto points = static_cast<std::size_t>(plan.points);
  change_.resize(n);
  double max_change = 0.0, max_difference = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    change_[i] = motion.v[i] - all_free_velocity_[i];
    max_change = std::max(max_change, std::abs(change_[i]));
    max_difference = std::max(max_difference, std::abs(all_free_velocity_[i] - (all_free_end_[i] - x0[i]) / h));
  }
  if (max_change == 0.0 || max_difference <= 1e-6 * max_change) return;
  if (decay_step_ != h) plan_dashpot_decay(plan, 0.5 * h, decay_);
  decay_step_ = h;

  // [J], by dashpots and by contact; [N s], [m/s]
  double energy = kinetic_energy(plan, motion.v), dashpot_work = 0.0, work = 0.0, impulses = 0.0, speed = 0.0;
  const auto change_of_energy = [&](const Field& velocity) {
    const double before = std::exchange(energy, kinetic_energy(plan, velocity));
    return energy - before;
  };
  Field& v = all_free_velocity_;
  for (int round = 0; round < transmissions; ++round) {
    decay_dashpots(plan, plan.spring.runs, decay_, SweepDirection::Backward, motion.x, change_);
    for_components(plan, [&](std::size_t i, Index point) { v[i] = plan.inverse_mass[point] != 0.0 ? v[i] + change_[i] : motion.v[i]; });
    change_ = v;
    dashpot_work += change_of_energy(v);

    // obstacles do what they did, and what touches does not approach
    for (std::size_t i = 0; i < n; ++i)
      if (has_collided_[i] != 0) v[i] = motion.v[i];
    if (touches) {
      for (std::size_t k = 0; k < x_.size(); ++k) velocity_[k] = point_in(plan, v, plan.surface.points[k]);
      contacts_.settle(inverse_mass_, plan.surface.friction, velocity_);
      for (std::size_t k = 0; k < x_.size(); ++k)
        for (int c = 0; c < plan.dimensions; ++c) v[c * points + plan.surface.points[k]] = velocity_[k][c];
    }
    work += change_of_energy(v);
    for (std::size_t i = 0; i < n; ++i) {
      const double before = change_[i];
      change_[i] = v[i] - before;
      if (round + 1 < transmissions) v[i] = before;
    }
  }
  for_components(plan, [&](std::size_t i, Index point) { impulses += plan.mass[point] * std::abs(v[i] - motion.v[i]); });
  motion.v = v;
  motion.dashpot_work += dashpot_work;
  if (plan.collider_paths.any_moves)
    for (const Obstacle& obstacle : obstacles) speed = std::max(speed, max_surface_speed(obstacle, anchor_of(*obstacle.collider), h));
  book_contact_work(work, {.by_hand = impulses * held_speed(plan, motion), .by_colliders = impulses * speed}, motion);
}

}  // namespace hooke
