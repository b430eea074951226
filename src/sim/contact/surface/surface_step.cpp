#include "sim/contact/surface/surface_step.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/contact/pair_solver.h"

namespace hooke {
namespace {

// The part of what features are closer than their thickness by which they separate in a substep, and the time for most of it [s].
constexpr double max_separation = 0.2, separation_time = 0.02;
// Forces that press features together by so many times the acceleration of gravity are not separated. With less, what lies in folds that
// bending presses does not come to rest; with more, weights on springs stretch them.
constexpr double max_pressing_gravities = 30.0;
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

void SurfaceStep::begin_substep(const Plan& plan, double velocity_lag, bool kicks_last, const Field* unlimited, DampingWork& damping,
                                const Motion& motion) {
  velocity_lag_ = velocity_lag;
  kicks_last_ = kicks_last;
  damping_ = &damping;
  is_limited_ = unlimited != nullptr;
  free_velocity_.resize(plan.surface.points.size());
  for (std::size_t k = 0; k < free_velocity_.size(); ++k)
    free_velocity_[k] = point_in(plan, unlimited != nullptr ? *unlimited : motion.v, plan.surface.points[k]);
  all_free_velocity_ = motion.v;
  all_free_end_ = motion.x;
}

bool SurfaceStep::resolve(const Plan& plan, std::span<const Obstacle> obstacles, std::span<const PointPair> near, const Field& x0,
                          const Field& v0, double h, Motion& motion) {
  contacts_.impulses = distances_ = 0;
  held_impulse_ = 0.0;
  note_collisions(plan, obstacles, h, motion);
  const bool touches = correct(plan, obstacles, near, x0, v0, h, motion);
  if (transmits(plan)) transmit_through_dashpots(plan, obstacles, x0, touches, h, motion);
  motion.counts.contact_tests += search_.tests() + distances_;
  motion.counts.contact_impulses += contacts_.impulses;
  return touches;
}

bool SurfaceStep::correct(const Plan& plan, std::span<const Obstacle> obstacles, std::span<const PointPair> near, const Field& x0,
                          const Field& v0, double h, Motion& motion) {
  has_failed_ = false;
  // a motion that is not finite has diverged
  if (!load(plan, x0, h, motion)) return false;
  if (!search_.is_begun()) start_frame(plan);
  motion.crossings = search_.crossings();
  search_.begin_substep(plan, x_, u_, h);
  has_failed_ = !search_.find_near(plan, x_);
  if (has_failed_ || !search_.is_any_near()) return false;

  make_contacts(plan, h);
  add_points(plan, near, h);
  add_obstacles(plan, obstacles, h, motion);
  free_u_ = u_;
  note_impacts(plan, v0, h, motion);
  const bool touches = contacts_.settle(inverse_mass_, plan.surface.friction, u_);
  note_pressed(plan, h);
  const bool is_separated = separate(plan, v0, h);
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
  local_.assign(plan.points, no_index);
  for (std::size_t k = 0; k < n; ++k) local_[plan.surface.points[k]] = static_cast<Index>(k);
  const auto held = plan.hand.held ? std::ranges::lower_bound(plan.surface.points, *plan.hand.held) : plan.surface.points.end();
  held_ = held != plan.surface.points.end() && *held == *plan.hand.held ? static_cast<Index>(held - plan.surface.points.begin()) : no_index;
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
  for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges})
    search_.visit_touching(plan.surface, kind, [&](const SurfacePair& pair, const Closest& closest, double approach) {
      const double gap =
          closest.distance - plan.surface.radius_of(pair.points) - search_.part(pair) * plan.surface.thickness_of(pair.points);
      if (gap < search_.max_gap(approach)) add_contact(pair.kind, pair.points, closest, gap, h);
    });
}

void SurfaceStep::add_contact(FeaturePair kind, const std::array<Index, 4>& points, const Closest& closest, double gap, double h) {
  SurfaceContact contact{.kind = kind, .points = points, .gap = gap, .target = std::min(0.0, -gap / h)};
  contact.move_to(closest, inverse_mass_);
  if (contact.response == 0.0) return;
  contact.is_driven = std::ranges::find(points, held_) != points.end();
  contacts_.surface.push_back(contact);
}

// Contact of points has resolved those that touch each other. What features do to one must not press it into another: of the pairs of
// points, those in a chain with a feature are contacts, too.
void SurfaceStep::add_points(const Plan& plan, std::span<const PointPair> near, double h) {
  contacts_.has_points = false;
  if (near.empty() || contacts_.surface.empty()) return;
  const auto is_free = [&](Index k) { return inverse_mass_[k] != 0.0; };
  const auto use_pairs = [&](const auto& use) {
    for (const PointPair& pair : near)
      if (const Index i = local_[pair.i], j = local_[pair.j]; i != no_index && j != no_index) use(pair, i, j);
  };
  chains_.reset(x_.size());
  use_pairs([&](const PointPair&, Index i, Index j) {
    if (is_free(i) && is_free(j)) chains_.join(i, j);
  });
  is_marked_.assign(x_.size(), 0);
  for (const SurfaceContact& contact : contacts_.surface)
    for (const Index k : contact.points)
      if (is_free(k)) is_marked_[chains_.root(k)] = 1;
  use_pairs([&](const PointPair& pair, Index i, Index j) {
    if (is_marked_[chains_.root(is_free(i) ? i : j)] == 0) return;
    const Vec3 separation = x_[i] - x_[j];
    const double distance = glm::length(separation);
    if (distance < coincident) return;
    contacts_.has_points = true;
    add_contact(FeaturePair::TwoEdges, {i, i, j, j}, {.weight = {1.0, 0.0, -1.0, 0.0}, .separation = separation, .distance = distance},
                distance - touching_distance(plan, pair), h);
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

// Displacements, without velocities, that separate what is closer than its thickness. Returns whether there are any. The harder forces
// other than gravity press, the less it separates: against springs, while friction holds what they would pull back, that would stretch them
// without end. Friction acts on these displacements, too.
bool SurfaceStep::separate(const Plan& plan, const Field& v0, double h) {
  path_ = u_;
  const double part = std::min(max_separation, h / separation_time);
  const auto is_close = [](const SurfaceContact& contact) { return contact.gap < 0.0; };
  if (std::ranges::none_of(contacts_.surface, is_close)) return false;
  // [m/s], by forces other than gravity in the substep
  shift_.resize(x_.size());
  double max_speed = 0.0;
  for (std::size_t k = 0; k < x_.size(); ++k) {
    const bool is_free = inverse_mass_[k] != 0.0;
    shift_[k] = is_free ? free_velocity_[k] - point_in(plan, v0, plan.surface.points[k]) - h * plan.gravity : Vec3(0.0);
    if (is_free) max_speed = std::max(max_speed, glm::length(free_velocity_[k]));
  }
  const double max_press = max_pressing_gravities * h * glm::length(plan.gravity) + 1e-12 * max_speed;  // of which the latter is rounding
  bool any = false;
  for (SurfaceContact& contact : contacts_.surface) {
    const double approach = -glm::dot(contact.normal, weighted(u_, contact.points, contact.weight));
    if (!is_close(contact)) {
      contact.target = std::min(0.0, contact.target + approach);
      continue;
    }
    const double press = -glm::dot(contact.normal, weighted(shift_, contact.points, contact.weight));
    const double left = max_press > 0.0 ? std::clamp(1.0 - press / max_press, 0.0, 1.0) : press > 0.0 ? 0.0 : 1.0;
    contact.target = approach - left * part * contact.gap / h;
    any = any || contact.target > 0.0;
  }
  if (!any) return false;
  for (ObstacleContact& contact : contacts_.obstacles)
    contact.target = std::min(0.0, contact.target - glm::dot(contact.normal, u_[contact.point]));
  shift_.assign(x_.size(), Vec3(0.0));
  any = contacts_.separate(inverse_mass_, plan.surface.friction, shift_);
  for (std::size_t k = 0; k < x_.size(); ++k) path_[k] += shift_[k];
  for (SurfaceContact& contact : contacts_.surface) contact.separating = contact.impulse.normal;
  for (ObstacleContact& contact : contacts_.obstacles) contact.pressing += contact.impulse.normal;
  return any;
}

}  // namespace hooke
