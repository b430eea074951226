#include "sim/contact/surface/surface_solver.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/contact/constants.h"
#include "sim/contact/pair_solver.h"

namespace hooke {

void SurfaceSolver::begin_frame() {
  detection_.clear();
  contacts_.begin_frame();
  impacts_.begin_frame();
}

// Returns whether all are finite: what is not has diverged.
bool SurfaceSolver::load(const Plan& plan, const Field& x0, double h, const Motion& motion) {
  const std::size_t n = plan.surface.points.size();
  for (auto* field : {&x_, &arm_, &u_, &free_u_}) field->resize(n);
  Vec3 sum(0.0);
  for (std::size_t k = 0; k < n; ++k) {
    const Index i = plan.surface.points[k];
    x_[k] = vector_at(plan, x0, i);
    free_u_[k] = u_[k] = (vector_at(plan, motion.x, i) - x_[k]) / h;
    arm_[k] = x_[k] + h * (u_[k] - vector_at(plan, motion.v, i));
    sum += u_[k];
  }
  return std::isfinite(sum.x + sum.y + sum.z);
}

void SurfaceSolver::start_frame(const Plan& plan) {
  const std::vector<Index>& points = plan.surface.points;
  inverse_mass_.resize(points.size());
  stopped_.reserve(points.size());
  inside_.reserve(points.size());
  local_.assign(plan.points, no_index);
  for (std::size_t k = 0; k < points.size(); ++k) {
    inverse_mass_[k] = plan.inverse_mass_in_contact()[points[k]];
    local_[points[k]] = static_cast<Index>(k);
  }
  held_ = plan.hand.held ? local_[*plan.hand.held] : no_index;
  detection_.begin_frame(plan.surface, x_);
}

bool SurfaceSolver::resolve(const Plan& plan, std::span<const Obstacle> obstacles, std::span<const PointPair> near, const Start& start,
                            double h, Motion& motion) {
  has_failed_ = false;
  if (!load(plan, start.x, h, motion)) return false;
  if (!detection_.is_begun()) start_frame(plan);
  const std::size_t n = x_.size();
  inverse_mass_.resize(n);
  motion.crossings = detection_.crossings();

  // pairs that are near, those of them that may touch, and what these may be pressed into
  has_failed_ = !detection_.find_near(plan.surface, x_, u_, h);
  motion.counts.contact_tests += detection_.tests();
  if (has_failed_) return false;
  const auto step = [&] {
    return SurfaceContacts::Step{
        .plan = plan.surface, .inverse_mass = inverse_mass_, .x = x_, .arm = arm_, .u = free_u_, .h = h, .held = held_};
  };
  contacts_.impulses = 0;
  contacts_.make(step(), detection_);
  if (!contacts_.all.empty())
    for (const PointPair& pair : near)
      if (const Index i = local_[pair.i], j = local_[pair.j]; i != no_index && j != no_index)
        contacts_.add_points(step(), i, j, touching_distance(plan, pair));
  if (contacts_.all.empty() && detection_.meeting().empty()) {
    contacts_.remember(step());
    return false;
  }
  if (!obstacles.empty()) mark_points();
  for (std::size_t o = 0; o < obstacles.size(); ++o) add_obstacle(plan, obstacles[o], static_cast<Index>(o), h, motion);

  // impulses on the paths, and impacts of what would meet nevertheless
  contacts_.solve_paths(step(), u_);
  has_failed_ = !prevent_impacts(plan, obstacles, h);
  motion.counts.contact_tests += impacts_.distances();
  if (has_failed_) return false;

  // velocities at the end
  velocity_ = u_;
  for (std::size_t k = 0; k < n; ++k) velocity_[k] = vector_at(plan, motion.v, plan.surface.points[k]) + (u_[k] - free_u_[k]);
  find_rebounds(plan, start, h, motion);
  contacts_.solve_ends(step(), u_, velocity_);
  motion.counts.contact_impulses += contacts_.impulses;
  write(plan, start, h, motion);
  return true;
}

void SurfaceSolver::mark_points() {
  is_marked_.assign(x_.size(), 0);
  for (const SurfaceContact& contact : contacts_.all)
    for (const Index k : contact.points) is_marked_[k] = 1;
}

// The points of contacts that may be pressed into the obstacle. It is convex: outside the plane that touches it where it is nearest,
// nothing is in it.
void SurfaceSolver::add_obstacle(const Plan& plan, const Obstacle& obstacle, Index number, double h, const Motion& motion) {
  const double reach = detection_.approach() + contact::slack * plan.surface.max_thickness;
  const Vec3 offset = obstacle.offset_at(h), velocity = obstacle.velocity_at(h);
  for (std::size_t k = 0; k < x_.size(); ++k) {
    if (is_marked_[k] == 0 || inverse_mass_[k] == 0.0) continue;
    const Index i = plan.surface.points[k];
    const Vec3 position = vector_at(plan, motion.x, i) - offset;
    const Gap gap = gap_to(*obstacle.collider, plan.radius[i], position);
    if (gap.distance > reach) continue;
    const auto point = static_cast<Index>(k), surface = static_cast<Index>(u_.size());
    u_.push_back(velocity + relative_surface_velocity(obstacle, gap.normal, position));
    inverse_mass_.push_back(0.0);
    const double path = glm::dot(gap.normal, u_[point] - u_[surface]);
    contacts_.all.push_back({.points = {point, point, surface, surface},
                             .weight = {1.0, 0.0, -1.0, 0.0},
                             .law = {.normal = gap.normal,
                                     .mass = 1.0 / inverse_mass_[point],
                                     .friction = obstacle.collider->friction,
                                     .target = path - std::max(0.0, gap.distance) / h},
                             .thickness = plan.surface.max_thickness,
                             .gap = gap.distance - h * path,
                             .pair = SurfaceContact::obstacle + number,
                             .kind = FeaturePair::TwoEdges});
  }
}

// Also with the obstacles, into which impacts must not lead. False: gave up.
bool SurfaceSolver::prevent_impacts(const Plan& plan, std::span<const Obstacle> obstacles, double h) {
  stopped_.clear();
  impacts_.begin_substep();
  do {
    impacts_.prevent(plan.surface, detection_, inverse_mass_, x_, h, held_, std::span(u_).first(x_.size()));
  } while (!impacts_.has_failed() && stop_lowest(plan, obstacles, h));
  for (const Index k : stopped_) inverse_mass_[k] = plan.inverse_mass_in_contact()[plan.surface.points[k]];
  return !impacts_.has_failed();
}

// Of the points that contact has led into obstacles, those closest to them at the start end their paths at their surface from now on:
// others may be on top of them. Returns whether there are any.
bool SurfaceSolver::stop_lowest(const Plan& plan, std::span<const Obstacle> obstacles, double h) {
  double lowest = std::numeric_limits<double>::infinity();
  inside_.clear();
  for (const Obstacle& obstacle : obstacles)
    for (std::size_t k = 0; k < x_.size(); ++k) {
      if (inverse_mass_[k] == 0.0 || u_[k] == free_u_[k]) continue;
      const double radius = plan.radius[plan.surface.points[k]];
      const Vec3 end = x_[k] + h * u_[k] - obstacle.offset_at(h);
      const Gap gap = gap_to(*obstacle.collider, radius, end);
      if (gap.distance >= -contact_tolerance(end)) continue;
      inside_.push_back({static_cast<Index>(k), gap_to(*obstacle.collider, radius, x_[k] - obstacle.offset_at(0.0)).distance,
                         -gap.distance / h * gap.normal});
      lowest = std::min(lowest, inside_.back().start);
    }
  for (const Inside& point : inside_) {
    if (point.start > lowest + 0.5 * plan.surface.max_thickness || inverse_mass_[point.k] == 0.0) continue;
    u_[point.k] += point.change;
    inverse_mass_[point.k] = 0.0;
    stopped_.push_back(point.k);
  }
  return !inside_.empty();
}

// The velocity after an impact is e times that with which the path first touches. The velocities of the method that belong to positions are
// ahead of it by its lag. What approaches slowly, or completes its further bounces, 2 e v / (a (1 - e)) long, within a substep, rests.
void SurfaceSolver::find_rebounds(const Plan& plan, const Start& start, double h, const Motion& motion) {
  const double e = plan.surface.restitution;
  if (e == 0.0) return;
  const double slow = std::max(contact::rest_speed, 0.5 * (1.0 - e) / e);
  for (SurfaceContact& contact : contacts_.all) {
    if (contact.is_on_obstacle()) break;
    double path = 0.0, before = 0.0, after = 0.0, supplied = 0.0;  // [m/s], along the normal
    for (int c = 0; c < 4; ++c) {
      const Index k = contact.points[c], i = plan.surface.points[k];
      const Vec3 weighted_normal = contact.weight[c] * contact.law.normal, v0 = vector_at(plan, start.v, i);
      path += glm::dot(weighted_normal, free_u_[k]);
      before += glm::dot(weighted_normal, v0);
      after += glm::dot(weighted_normal, vector_at(plan, motion.v, i));
      supplied += glm::dot(weighted_normal, vector_at(plan, start.free_v, i) - v0);
    }
    const double part = path < 0.0 ? std::clamp(-contact.gap / (h * path), 0.0, 1.0) : 1.0;
    const double ahead = start.velocity_lag * supplied, approach = -(before + part * (after - before) + ahead);
    if (approach > slow * std::abs(supplied)) contact.law.target = e * approach - ahead;
  }
}

// Positions and velocities at the end, and the work of contact in addition to that of the forces.
void SurfaceSolver::write(const Plan& plan, const Start& start, double h, Motion& motion) {
  work_ = lag_work_ = 0.0;
  for (std::size_t k = 0; k < x_.size(); ++k) {
    const Index i = plan.surface.points[k];
    const Vec3 v1 = vector_at(plan, motion.v, i);
    if (inverse_mass_[k] == 0.0 || (u_[k] == free_u_[k] && velocity_[k] == v1)) continue;
    const Vec3 supplied = vector_at(plan, start.free_v, i) - vector_at(plan, start.v, i);
    const double kinetic = 0.5 * (glm::dot(velocity_[k], velocity_[k]) - glm::dot(v1, v1));
    work_ += plan.mass[i] * (kinetic - glm::dot(supplied, u_[k] - free_u_[k]));
    lag_work_ += plan.mass[i] * start.velocity_lag * glm::dot(supplied, velocity_[k] - v1);
    add_vector(plan, motion.x, i, h * (u_[k] - free_u_[k]));
    set_vector(plan, motion.v, i, velocity_[k]);
  }
}

}  // namespace hooke
