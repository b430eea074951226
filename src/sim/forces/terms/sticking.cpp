#include "sim/forces/terms/sticking.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/forces/constants.h"
#include "sim/forces/forces.h"

namespace hooke {
namespace {

double along(const Plan& plan, const Vec3& normal, const double* field, Index point) {
  double sum = 0.0;
  for (int c = 0; c < plan.dimensions; ++c) sum += normal[c] * field[static_cast<std::size_t>(c) * plan.points + point];
  return sum;
}

void add_along(const Plan& plan, const Vec3& normal, double length, Index point, Field& field) {
  for (int c = 0; c < plan.dimensions; ++c) field[static_cast<std::size_t>(c) * plan.points + point] += length * normal[c];
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

bool contains(const std::vector<StickyContact>& list, const StickyContact& contact) {
  return std::ranges::find(list, contact) != list.end();
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
    if (distance > 0.0) add_along(plan, normal, -distance, contact.point, motion.x);
    if (relative > 0.0) {
      add_along(plan, normal, -relative, contact.point, motion.v);
      motion.contact_work -= 0.5 * plan.mass[contact.point] * relative * relative;
      motion.collider_work -= plan.mass[contact.point] * relative * speed;
    }
    if (std::max(distance, relative) > sticky_round_off) motion.acceleration_is_current = false;
  }
}

void Sticking::begin_frame(Plan& plan, const Motion& motion) {
  plan.force_data.sticky.held.clear();
  if (plan.force_data.sticky.strength == 0.0) return;
  const auto is_plane = [](const Collider& collider) { return std::holds_alternative<Plane>(collider.shape); };
  const auto size = static_cast<std::size_t>(plan.points * std::ranges::count_if(plan.colliders, is_plane));
  for (auto* list : {&plan.force_data.sticky.held, &none_, &previous_, &released_, &candidates_}) list->reserve(size), list->clear();
  for (auto* list : {&pull_, &start_pull_}) list->reserve(size), list->clear();
  for (Field* field : {&x_, &v_, &f_}) field->resize(motion.x.size());
}

void Sticking::begin_step(Plan& plan, Motion& motion) {
  if (plan.force_data.sticky.strength == 0.0) return;
  std::swap(previous_, plan.force_data.sticky.held);
  plan.force_data.sticky.held.clear();
  for (std::size_t k = 0; k < plan.colliders.size(); ++k) {
    if (!std::holds_alternative<Plane>(plan.colliders[k].shape)) continue;
    for (Index i = 0; i < plan.points; ++i) {
      const StickyContact contact{i, static_cast<Index>(k)};
      if (plan.inverse_mass[i] != 0.0 && is_at_rest_on(plan, contact, motion) && !contains(released_, contact))
        plan.force_data.sticky.held.push_back(contact);
    }
  }
  if (!plan.force_data.sticky.held.empty()) {
    excess(plan, motion.time, motion.x, motion.v, motion);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < pull_.size(); ++k) {
      if (pull_[k] > plan.force_data.sticky.strength) continue;
      plan.force_data.sticky.held[kept] = plan.force_data.sticky.held[k];
      pull_[kept++] = pull_[k];
    }
    plan.force_data.sticky.held.resize(kept);
    pull_.resize(kept);
    start_pull_ = pull_;
  }
  if (plan.force_data.sticky.held != previous_) motion.acceleration_is_current = false;
}

// [N], by which the pull on the held points exceeds the strength, the maximum over them. The force of the planes itself does not count.
double Sticking::excess(Plan& plan, double time, const Field& x, const Field& v, Motion& motion) {
  std::swap(plan.force_data.sticky.held, none_);
  compute_forces(plan, time, x, v, f_);
  std::swap(plan.force_data.sticky.held, none_);
  ++motion.counts.force_evaluations;
  pull_.clear();
  double max = -plan.force_data.sticky.strength;
  for (const StickyContact& contact : plan.force_data.sticky.held) {
    pull_.push_back(pull_on(plan, contact, time, f_.data()));
    max = std::max(max, pull_.back() - plan.force_data.sticky.strength);
  }
  return max;
}

// On the cubic through both ends of the step, t after its start.
double Sticking::excess_at(Plan& plan, double t, Motion& motion) {
  const double s = t / h_, r = 1.0 - s, a = r * r * (1.0 + 2.0 * s), b = s * r * r * h_, c = s * s * (3.0 - 2.0 * s), d = -s * s * r * h_;
  const double slope = 6.0 * s * r / h_, from = r * (1.0 - 3.0 * s), to = s * (3.0 * s - 2.0);
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const double x0 = (*x0_)[i], v0 = (*v0_)[i], x1 = motion.x[i], v1 = motion.v[i];
    x_[i] = a * x0 + b * v0 + c * x1 + d * v1;
    v_[i] = slope * (x1 - x0) + from * v0 + to * v1;
  }
  return excess(plan, start_ + t, x_, v_, motion);
}

void Sticking::end_step(bool is_at_release) {
  released_.clear();
  if (is_at_release) release_at_start();
}

// Of a step that is not repeated, by the trapezoidal rule.
void Sticking::add_work(const Plan& plan, Motion& motion) const {
  if (!plan.collider_paths.any_moves) return;
  for (std::size_t k = 0; k < pull_.size(); ++k) {
    const double start = std::max(0.0, start_pull_[k]) * speed_of_plane(plan, plan.force_data.sticky.held[k], start_);
    const double end = std::max(0.0, pull_[k]) * speed_of_plane(plan, plan.force_data.sticky.held[k], start_ + h_);
    motion.collider_work -= 0.5 * h_ * (start + end);
  }
}

// A time [s] after the start of the step at which the pull exceeds the strength; infinity: at none. `excess` is that at the start of the
// step, and becomes that at this time.
double Sticking::time_beyond(Plan& plan, double& excess, double at_end, Motion& motion) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (at_end > 0.0) return excess = at_end, h_;
  // it may exceed it and fall again: the parabola through its values at both ends and in the middle
  const double h_omega = h_ * plan.spectrum.omega, at_start = excess;
  const double margin = 0.25 * plan.force_data.sticky.strength * h_omega * std::max(1.0, h_omega) + 2.0 * std::abs(at_end - at_start);
  if (std::max(at_start, at_end) < -margin) return none;
  excess = excess_at(plan, 0.5 * h_, motion);
  if (excess > 0.0) return 0.5 * h_;
  const double bend = at_start - 2.0 * excess + at_end;
  if (!(bend < 0.0)) return none;
  const double peak = h_ * std::clamp(0.5 - 0.25 * (at_end - at_start) / bend, 0.0, 1.0);
  excess = excess_at(plan, peak, motion);
  return excess > 0.0 ? peak : none;
}

double Sticking::time_of_release(Plan& plan, const Field& x0, const Field& v0, double start, double h, Motion& motion) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (plan.force_data.sticky.held.empty()) return none;
  x0_ = &x0;
  v0_ = &v0;
  start_ = start;
  h_ = h;
  const double strength = plan.force_data.sticky.strength, at_start = *std::ranges::max_element(start_pull_) - strength;
  const double at_end = excess(plan, start + h, motion.x, motion.v, motion);
  add_work(plan, motion);
  if (!std::isfinite(at_end)) return none;
  double above = at_start, high = time_beyond(plan, above, at_end, motion);
  if (high == none || releases_ >= max_releases) return none;
  ++releases_;

  // regula falsi (Illinois)
  double low = 0.0, below = at_start;
  int side = 0;
  for (int i = 0; i < max_release_iterations && high - low > release_resolution * h && above > 1e-12 * strength; ++i) {
    const double margin = 0.01 * (high - low), t = std::clamp(low - below * (high - low) / (above - below), low + margin, high - margin);
    const double value = excess_at(plan, t, motion);
    const int last = side;
    side = value > 0.0 ? 1 : -1;
    if (value > 0.0) {
      high = t;
      above = value;
      if (last == side) below *= 0.5;
    } else {
      low = t;
      below = value;
      if (last == side) above *= 0.5;
    }
  }
  excess_at(plan, high, motion);
  candidates_.clear();
  for (std::size_t k = 0; k < pull_.size(); ++k)
    if (pull_[k] >= (1.0 - 1e-9) * strength) candidates_.push_back(plan.force_data.sticky.held[k]);
  return high > (1.0 - negligible_part) * h ? h : high > negligible_part * h ? high : 0.0;
}

}  // namespace hooke
