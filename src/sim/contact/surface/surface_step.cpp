#include "sim/contact/surface/surface_step.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/contact/closest_kernel.h"

namespace hooke {
namespace {

// The part of what features are closer than their thickness by which they separate in a substep, and the time for most of it [s].
constexpr double max_separation = 0.2, separation_time = 0.02;
// [m/s], away from an obstacle on which a point rests, by rounding
constexpr double resting_speed = 1e-9;

Vec3 mean_of(std::span<const Vec3> field) {
  Vec3 sum(0.0);
  for (const Vec3& v : field) sum += v;
  return sum / static_cast<double>(field.size());
}

ContactImpulse split(const Vec3& impulse, const Vec3& normal) {
  const double along = glm::dot(impulse, normal);
  return {std::max(0.0, along), impulse - along * normal};
}

}  // namespace

void SurfaceStep::begin_substep(const Plan& plan, double velocity_lag, bool kicks_last, const Field* unlimited, const Motion& motion) {
  velocity_lag_ = velocity_lag;
  kicks_last_ = kicks_last;
  is_limited_ = unlimited != nullptr;
  free_velocity_.resize(plan.surface.points.size());
  for (std::size_t k = 0; k < free_velocity_.size(); ++k)
    free_velocity_[k] = point_in(plan, unlimited != nullptr ? *unlimited : motion.v, plan.surface.points[k]);
  all_free_velocity_ = motion.v;
  all_free_end_ = motion.x;
}

bool SurfaceStep::resolve(const Plan& plan, std::span<const Obstacle> obstacles, const Field& x0, const Field& v0, double h,
                          Motion& motion) {
  contacts_.impulses = distances_ = 0;
  held_impulse_ = 0.0;
  note_collisions(motion);
  const bool touches = correct(plan, obstacles, x0, v0, h, motion);
  if (transmits(plan)) transmit_through_dashpots(plan, obstacles, x0, touches, h, motion);
  motion.contact_tests += search_.tests() + distances_;
  motion.contact_impulses += contacts_.impulses;
  return touches;
}

bool SurfaceStep::correct(const Plan& plan, std::span<const Obstacle> obstacles, const Field& x0, const Field& v0, double h,
                          Motion& motion) {
  has_failed_ = false;
  // a motion that is not finite has diverged
  if (!load(plan, x0, h, motion)) return false;
  if (!search_.is_begun()) start_frame(plan);
  search_.begin_substep(plan, x_, u_, h);
  has_failed_ = !search_.find_near(plan, x_);
  if (has_failed_ || !search_.is_any_near()) return false;

  make_contacts(plan, h);
  add_obstacles(plan, obstacles, h, motion);
  free_u_ = u_;
  note_impacts(plan, v0, h, motion);
  const bool touches = contacts_.settle(inverse_mass_, plan.surface.friction, u_);
  note_pressed(plan, h);
  const bool is_separated = separate(h);
  separated_ = path_;
  const bool hits = prevent_crossings(plan, h);
  if (has_failed_ || !(touches || is_separated || hits)) return false;
  write(plan, v0, h, motion);
  return true;
}

// Returns whether all are finite.
bool SurfaceStep::load(const Plan& plan, const Field& x0, double h, const Motion& motion) {
  const std::size_t n = plan.surface.points.size();
  for (auto* field : {&x_, &end_, &u_}) field->resize(n);
  Vec3 sum(0.0);
  for (std::size_t k = 0; k < n; ++k) {
    const Index i = plan.surface.points[k];
    x_[k] = point_in(plan, x0, i);
    end_[k] = point_in(plan, motion.x, i);
    u_[k] = (end_[k] - x_[k]) / h;
    sum += u_[k];
  }
  return std::isfinite(sum.x + sum.y + sum.z);
}

void SurfaceStep::start_frame(const Plan& plan) {
  const std::size_t n = plan.surface.points.size();
  inverse_mass_.resize(n);
  for (std::size_t k = 0; k < n; ++k) inverse_mass_[k] = plan.inverse_mass[plan.surface.points[k]];
  const auto held = plan.held ? std::ranges::lower_bound(plan.surface.points, *plan.held) : plan.surface.points.end();
  held_ = held != plan.surface.points.end() && *held == *plan.held ? static_cast<Index>(held - plan.surface.points.begin()) : no_index;
  search_.begin_frame(plan, x_);
  impacts_ = 0;
  excess_ = 0;
}

// Relative to the mean.
double SurfaceStep::max_speed(std::span<const Vec3> velocity) const {
  const Vec3 mean = mean_of(velocity);
  double max = 0.0;
  for (const Vec3& v : velocity) max = std::max(max, glm::dot(v - mean, v - mean));
  return std::sqrt(max);
}

void SurfaceStep::make_contacts(const Plan& plan, double h) {
  contacts_.surface.clear();
  contacts_.obstacles.clear();
  const std::vector<double>& thickness = plan.surface.thickness;
  for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges})
    search_.visit_touching(plan.surface, kind, [&](const SurfacePair& pair, const Closest& closest, double approach) {
      const auto& [i, j, k, l] = pair.points;
      const double gap = closest.distance - plan.surface.radius_of(i) -
                         search_.part(pair) * std::min({thickness[i], thickness[j], thickness[k], thickness[l]});
      if (gap >= search_.max_gap(approach)) return;
      SurfaceContact contact{.kind = pair.kind, .points = pair.points, .gap = gap};
      contact.move_to(closest, inverse_mass_);
      if (contact.response == 0.0) return;
      contact.is_driven = std::ranges::find(contact.points, held_) != contact.points.end();
      contact.target = std::min(0.0, -gap / h);
      contacts_.surface.push_back(contact);
    });
}

// The obstacles that the points of contacts may be pressed into. They are convex: outside the plane that touches one where it is nearest,
// nothing is in it.
void SurfaceStep::add_obstacles(const Plan& plan, std::span<const Obstacle> obstacles, double h, const Motion& motion) {
  if (obstacles.empty()) return;
  const double reach = 2.0 * h * max_speed(u_);
  is_marked_.assign(plan.surface.points.size(), 0);
  for (const SurfaceContact& contact : contacts_.surface)
    for (const Index k : contact.points) is_marked_[k] = 1;
  for (std::size_t k = 0; k < is_marked_.size(); ++k) {
    if (is_marked_[k] == 0 || inverse_mass_[k] == 0.0) continue;
    const Index i = plan.surface.points[k];
    const Vec3 end = point_in(plan, motion.x, i);
    for (const Obstacle& obstacle : obstacles) {
      const Vec3 position = end - obstacle.offset_at(h);
      const Gap gap = gap_to(*obstacle.collider, plan.radius[i], position);
      if (gap.distance > reach) continue;
      const Vec3 velocity = obstacle.velocity_at(h);
      ObstacleContact contact{.point = static_cast<Index>(k),
                              .normal = gap.normal,
                              .target = glm::dot(gap.normal, u_[k]) - std::max(0.0, gap.distance) / h,
                              .end_target = glm::dot(gap.normal, velocity),
                              .friction = obstacle.collider->friction,
                              .surface = velocity + relative_surface_velocity(obstacle, gap.normal, position)};
      // where the point rests on it, what it did in the substep is taken back as far as others carry the point
      const Vec3 v1 = point_in(plan, motion.v, i);
      if (gap.distance <= contact_tolerance(position) && std::abs(glm::dot(gap.normal, v1) - contact.end_target) <= resting_speed) {
        const Vec3 of_path = (end - point_in(plan, all_free_end_, i)) / (h * inverse_mass_[k]);
        contact.impulse = split(of_path, gap.normal);
        contact.end_impulse = split((v1 - free_velocity_[k]) / inverse_mass_[k] - of_path, gap.normal);
      }
      contacts_.obstacles.push_back(contact);
    }
  }
}

// What touches at the end of the substep.
void SurfaceStep::note_pressed(const Plan& plan, double h) {
  const double tolerance = 1e-6 * plan.surface.max_thickness;
  for (SurfaceContact& contact : contacts_.surface) {
    Vec3 relative(0.0);
    for (int c = 0; c < 4; ++c) relative += contact.weight[c] * u_[contact.points[c]];
    contact.pressing = contact.impulse.normal;
    contact.is_pressed = contact.impulse.normal > 0.0 || contact.gap + h * glm::dot(contact.normal, relative) <= tolerance;
  }
  for (ObstacleContact& contact : contacts_.obstacles) {
    contact.pressing = contact.impulse.normal;
    contact.is_pressed = contact.impulse.normal > 0.0 || contact.end_impulse.normal > 0.0;
  }
}

// Displacements, without velocities, that separate what is closer than its thickness. Returns whether there are any.
bool SurfaceStep::separate(double h) {
  path_ = u_;
  bool any = false;
  const double part = std::min(max_separation, h / separation_time);
  for (SurfaceContact& contact : contacts_.surface)
    if (contact.gap < 0.0) {
      contact.target = -part * contact.gap / h;
      any = true;
    }
  if (!any) return false;
  any = contacts_.separate(inverse_mass_, path_);
  for (SurfaceContact& contact : contacts_.surface) contact.separating = contact.impulse.normal;
  for (ObstacleContact& contact : contacts_.obstacles) contact.pressing += contact.impulse.normal;
  return any;
}

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
    arm_[k] = x_[k] + h * (free_u_[k] - v1);
    separating_arm_[k] = -h * (v1 + (u_[k] - free_u_[k]));
  }
  for (const SurfaceContact& contact : contacts_.surface) {
    if (contact.impulse == 0.0) continue;
    const Vec3 arm = (contact.impulse - contact.separating) * weighted(arm_, contact.points, contact.weight) +
                     contact.separating * weighted(separating_arm_, contact.points, contact.weight);
    remove_angular_momentum(glm::cross(arm, contact.normal), contact.points, end_, inverse_mass_, velocity_);
  }
  for (std::size_t k = 0; k < n; ++k) arm_[k] = x_[k] + h * separated_[k] + separating_arm_[k];
  for (const Hit& hit : hits_)
    remove_angular_momentum(glm::cross(weighted(arm_, hit.points, hit.weight), hit.push), hit.points, end_, inverse_mass_, velocity_);
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
  // friction causes far larger ones
  if (plan.surface.friction == 0.0) remove_torques(plan, h, motion);
  // what was kept from approaching does not at the end either: the second half of a step of the method accelerates it again
  std::erase_if(contacts_.surface, [](const SurfaceContact& contact) { return !contact.is_pressed; });
  std::erase_if(contacts_.obstacles, [](const ObstacleContact& contact) { return !contact.is_pressed; });
  for (SurfaceContact& contact : contacts_.surface) contact.target = 0.0;
  for (ObstacleContact& contact : contacts_.obstacles) contact.target = contact.end_target;
  move_contacts();
  settle_velocities(plan);
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
  if (plan.held) {
    double impulses = held_impulse_;
    for (const SurfaceContact& contact : contacts_.surface)
      for (int c = 0; c < 4; ++c)
        if (plan.surface.points[contact.points[c]] == plan.held)
          impulses += std::abs(contact.weight[c]) * contact.impulse * (1.0 + plan.surface.friction);
    supplied.by_hand = impulses * held_speed(plan, motion);
  }
  for (const ObstacleContact& contact : contacts_.obstacles)
    supplied.by_colliders += contact.impulse * (1.0 + contact.friction) * glm::length(contact.surface);
  return supplied;
}

void SurfaceStep::settle_velocities(const Plan& plan) {
  for (int turn = 0; turn < velocity_turns && contacts_.settle(inverse_mass_, plan.surface.friction, velocity_); ++turn)
    impulses_ += 2 * static_cast<long>(contacts_.surface.size());
}

// What obstacles have changed since begin_substep.
void SurfaceStep::note_collisions(const Motion& motion) {
  has_collided_.resize(motion.v.size());
  for (std::size_t i = 0; i < motion.v.size(); ++i) has_collided_[i] = motion.v[i] != all_free_velocity_[i] ? 1 : 0;
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

  double work = -kinetic_energy_of(plan, motion.v), impulses = 0.0, speed = 0.0;  // [J], [N s], [m/s]
  Field& v = all_free_velocity_;
  for (int round = 0; round < transmissions; ++round) {
    decay_dashpots(plan, plan.runs, decay_, SweepDirection::Backward, motion.x, change_);
    for_components(plan, [&](std::size_t i, Index point) { v[i] = plan.inverse_mass[point] != 0.0 ? v[i] + change_[i] : motion.v[i]; });
    change_ = v;

    // obstacles do what they did, and what touches does not approach
    for (std::size_t i = 0; i < n; ++i)
      if (has_collided_[i] != 0) v[i] = motion.v[i];
    if (touches) {
      for (std::size_t k = 0; k < x_.size(); ++k) velocity_[k] = point_in(plan, v, plan.surface.points[k]);
      settle_velocities(plan);
      for (std::size_t k = 0; k < x_.size(); ++k)
        for (int c = 0; c < plan.dimensions; ++c) v[c * points + plan.surface.points[k]] = velocity_[k][c];
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double before = change_[i];
      change_[i] = v[i] - before;
      if (round + 1 < transmissions) v[i] = before;
    }
  }
  for_components(plan, [&](std::size_t i, Index point) { impulses += plan.mass[point] * std::abs(v[i] - motion.v[i]); });
  motion.v = v;
  work += kinetic_energy_of(plan, motion.v);
  if (plan.colliders_move)
    for (const Obstacle& obstacle : obstacles) speed = std::max(speed, max_surface_speed(obstacle, anchor_of(*obstacle.collider), h));
  book_contact_work(work, {.by_hand = impulses * held_speed(plan, motion), .by_colliders = impulses * speed}, motion);
}

}  // namespace hooke
