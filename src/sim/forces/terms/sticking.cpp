#include "sim/forces/terms/sticking.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/constants.h"
#include "sim/forces/forces.h"

namespace hooke {
namespace {

double along(const Plan& plan, const Vec3& normal, const double* field, Index point) {
  return glm::dot(normal, vector_at(plan, field, point));
}

double height_of(const Plan& plan, const StickyContact& contact, double time) {
  const auto& plane = std::get<Plane>(plan.colliders[contact.collider].shape);
  return glm::dot(plane.normal, plane.point + plan.offset_of(contact.collider, time));
}

// [m/s], along the normal.
double speed_of_plane(const Plan& plan, const StickyContact& contact, double time) {
  return glm::dot(normal_of(plan, contact), plan.velocity_of(contact.collider, time));
}

bool is_at_rest_on(const Plan& plan, const StickyContact& contact, const Motion& motion) {
  const Vec3& normal = normal_of(plan, contact);
  const double distance = along(plan, normal, motion.x.data(), contact.point) - height_of(plan, contact, motion.time);
  if (std::abs(distance - plan.radius[contact.point]) > sticky_distance) return false;
  const double speed = speed_of_plane(plan, contact, motion.time), relative = along(plan, normal, motion.v.data(), contact.point) - speed;
  return std::abs(relative) <= sticky_speed * (1.0 + std::abs(speed));
}

}  // namespace

const Vec3& normal_of(const Plan& plan, const StickyContact& contact) {
  return std::get<Plane>(plan.colliders[contact.collider].shape).normal;
}

double pull_on(const Plan& plan, const StickyContact& contact, double time, const double* f) {
  const Vec3& normal = normal_of(plan, contact);
  const double pull = along(plan, normal, f, contact.point);
  const ColliderPath& path = plan.colliders[contact.collider].path;
  return path.amplitude == Vec3(0.0) ? pull : pull - plan.mass[contact.point] * glm::dot(normal, path.acceleration(time));
}

void keep_on_planes(const Plan& plan, double time, Motion& motion) {
  for (const StickyContact& contact : plan.force_data.sticky.held) {
    const Vec3& normal = normal_of(plan, contact);
    const double speed = speed_of_plane(plan, contact, time), relative = along(plan, normal, motion.v.data(), contact.point) - speed;
    const double distance =
        along(plan, normal, motion.x.data(), contact.point) - height_of(plan, contact, time) - plan.radius[contact.point];
    if (distance > 0.0) add_vector(plan, motion.x, contact.point, -distance * normal);
    if (relative > 0.0) {
      add_vector(plan, motion.v, contact.point, -relative * normal);
      motion.energy.add(EnergyCause::Contact, -0.5 * plan.mass[contact.point] * relative * relative);
      motion.energy.add(EnergyCause::Colliders, -plan.mass[contact.point] * relative * speed);
    }
    if (std::max(distance, relative) > sticky_round_off) motion.acceleration_is_current = false;
  }
}

void Sticking::begin_frame(Plan& plan, const Motion& motion) {
  plan.force_data.sticky.held.clear();
  if (plan.force_data.sticky.strength == 0.0) return;
  const auto is_plane = [](const Collider& collider) { return std::holds_alternative<Plane>(collider.shape); };
  const auto size = static_cast<std::size_t>(plan.points * std::ranges::count_if(plan.colliders, is_plane));
  for (auto* list : {&plan.force_data.sticky.held, &none_, &previous_}) list->reserve(size), list->clear();
  for (auto* list : {&pull_, &start_pull_}) list->reserve(size), list->clear();
  f_.resize(motion.x.size());
}

void Sticking::begin_step(Plan& plan, Motion& motion) {
  if (plan.force_data.sticky.strength == 0.0) return;
  std::swap(previous_, plan.force_data.sticky.held);
  plan.force_data.sticky.held.clear();
  for (std::size_t k = 0; k < plan.colliders.size(); ++k) {
    if (!std::holds_alternative<Plane>(plan.colliders[k].shape)) continue;
    for (Index i = 0; i < plan.points; ++i) {
      const StickyContact contact{i, static_cast<Index>(k)};
      if (plan.inverse_mass[i] != 0.0 && is_at_rest_on(plan, contact, motion)) plan.force_data.sticky.held.push_back(contact);
    }
  }
  if (!plan.force_data.sticky.held.empty()) {
    compute_pulls(plan, motion);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < pull_.size(); ++k) {
      if (pull_[k] > plan.force_data.sticky.strength) continue;
      plan.force_data.sticky.held[kept] = plan.force_data.sticky.held[k];
      pull_[kept++] = pull_[k];
    }
    plan.force_data.sticky.held.resize(kept);
    pull_.resize(kept);
  }
  if (plan.force_data.sticky.held != previous_) motion.acceleration_is_current = false;
}

// The force of the planes itself does not count.
void Sticking::compute_pulls(Plan& plan, Motion& motion) {
  std::swap(plan.force_data.sticky.held, none_);
  compute_forces(plan, motion.time, motion.x, motion.v, f_);
  std::swap(plan.force_data.sticky.held, none_);
  ++motion.counts.force_evaluations;
  pull_.clear();
  for (const StickyContact& contact : plan.force_data.sticky.held) pull_.push_back(pull_on(plan, contact, motion.time, f_.data()));
}

// By the trapezoidal rule for the force of the planes, at their speed.
void Sticking::end_step(Plan& plan, double h, Motion& motion) {
  if (plan.force_data.sticky.held.empty() || !plan.collider_paths.any_moves) return;
  std::swap(pull_, start_pull_);
  compute_pulls(plan, motion);
  for (std::size_t k = 0; k < pull_.size(); ++k) {
    const double start = std::max(0.0, start_pull_[k]) * speed_of_plane(plan, plan.force_data.sticky.held[k], motion.time - h);
    const double end = std::max(0.0, pull_[k]) * speed_of_plane(plan, plan.force_data.sticky.held[k], motion.time);
    motion.energy.add(EnergyCause::Colliders, -0.5 * h * (start + end));
  }
}

}  // namespace hooke
