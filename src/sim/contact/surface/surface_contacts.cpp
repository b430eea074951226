#include "sim/contact/surface/surface_contacts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "sim/contact/constants.h"

namespace hooke {
namespace {

// Of the first feature, as seen from the second.
Vec3 relative(const SurfaceContact& contact, std::span<const Vec3> field) {
  const auto& [i, j, k, l] = contact.points;
  const std::array<double, 4>& w = contact.weight;
  return w[0] * field[i] + w[1] * field[j] + w[2] * field[k] + w[3] * field[l];
}

void apply(const SurfaceContact& contact, const Vec3& impulse, std::span<const double> inverse_mass, std::span<Vec3> velocity) {
  for (int c = 0; c < 4; ++c) velocity[contact.points[c]] += inverse_mass[contact.points[c]] * contact.weight[c] * impulse;
}

// The impulse that reaches the target. What separates is pushed by no more than a spring would; what approaches is stopped in any case.
void solve(SurfaceContact& contact, std::span<const double> inverse_mass, double friction, std::span<Vec3> velocity) {
  const Vec3 v = relative(contact, velocity);
  const double normal_velocity = glm::dot(contact.normal, v);
  if (contact.impulse.normal == 0.0 && !(normal_velocity < contact.target)) return;
  double impulse = contact.impulse.normal + (contact.target - normal_velocity) / contact.response;
  if (contact.target > 0.0)
    impulse = std::min(impulse, std::max(contact.max_push, contact.impulse.normal - normal_velocity / contact.response));
  const Vec3 slip = v - normal_velocity * contact.normal;
  apply(contact,
        change_impulse(contact.impulse, std::clamp(impulse, 0.0, contact.max_impulse), contact.normal, friction, slip, contact.response),
        inverse_mass, velocity);
}

void solve(ObstacleContact& contact, std::span<const double> inverse_mass, std::span<Vec3> velocity) {
  Vec3& v = velocity[contact.point];
  const double response = inverse_mass[contact.point], normal_velocity = glm::dot(contact.normal, v);
  if (contact.impulse.normal == 0.0 && !(normal_velocity < contact.target)) return;
  const double impulse = std::max(0.0, contact.impulse.normal + (contact.target - normal_velocity) / response);
  const Vec3 relative = v - contact.surface, slip = relative - glm::dot(contact.normal, relative) * contact.normal;
  v += response * change_impulse(contact.impulse, impulse, contact.normal, contact.friction, slip, response);
}

Vec3 across(const Vec3& normal, const Vec3& w) { return w - glm::dot(normal, w) * normal; }

ContactImpulse scaled(const ContactImpulse& impulse, double factor, const Vec3& normal) {
  return {factor * impulse.normal, factor * across(normal, impulse.friction)};
}
Vec3 total(const ContactImpulse& impulse, const Vec3& normal) { return impulse.normal * normal + impulse.friction; }

}  // namespace

void SurfaceContacts::begin_frame() {
  last_.clear();
  last_points_.clear();
  last_obstacles_.clear();
  last_h_ = 0.0;
}

void SurfaceContacts::make(const Step& step, const SurfaceDetection& detection) {
  surface.clear();
  obstacles.clear();
  list_ = detection.list_number();
  const double slack = contact::slack * step.plan.max_thickness;
  for (const SurfaceDetection::Near& near : detection.near()) {
    if (!near.touches) continue;
    SurfaceContact contact{.points = near.points,
                           .weight = near.closest.weight,
                           .normal = near.closest.separation / near.closest.distance,
                           .thickness = near.contact,
                           .gap = near.closest.distance - near.contact,
                           .pair = near.pair,
                           .kind = near.kind};
    if (contact.gap + step.h * glm::dot(contact.normal, relative(contact, step.u)) < slack) add(step, contact);
  }
}

void SurfaceContacts::add_points(const Step& step, Index i, Index j, double distance) {
  const Vec3 separation = step.x[i] - step.x[j];
  const double length = glm::length(separation);
  if (length <= contact::coincident * distance) return;
  add(step, {.points = {i, i, j, j},
             .weight = {1.0, 0.0, -1.0, 0.0},
             .normal = separation / length,
             .thickness = distance,
             .gap = length - distance});
}

// Overlaps are removed by the velocity omega / (2 zeta + h omega) times the overlap, which is the bias of a soft constraint with frequency
// omega and damping ratio zeta (E. Catto, Box2D v3, b2MakeSoft), and by no more than the force of its spring. Unlike there, what approaches
// is stopped by any force: the constraint is rigid in that direction. The mass of the spring is that of the contact, and never more than
// what accelerates its points by omega^2 times the overlap.
//
// An impulse J on weights w that changes x1 by h J w / m and v1 by J w / m adds the angular momentum sum w (x1 - h v1) x J. So its
// direction is that of sum w (x1 - h v1), which is the line between the closest points for methods with x1 = x0 + h v1, and nearly that for
// others.
void SurfaceContacts::add(const Step& step, SurfaceContact contact) {
  const Vec3 arm = relative(contact, step.arm);
  const double length = std::sqrt(glm::dot(arm, arm));
  constexpr double min_cosine = 0.9;
  if (step.plan.friction == 0.0 && glm::dot(arm, contact.normal) > min_cosine * length) contact.normal = arm / length;
  double fastest = 0.0;  // [1/kg], velocity of a point per impulse
  for (int c = 0; c < 4; ++c) {
    const double change = contact.weight[c] * step.inverse_mass[contact.points[c]];
    contact.response += contact.weight[c] * change;
    fastest = std::max(fastest, std::abs(change));
  }
  if (contact.response == 0.0) return;
  if (contact.gap >= 0.0) {
    contact.target = -contact.gap / step.h;
  } else {
    const double frequency = std::min(step.plan.frequency, contact::max_frequency / step.h);
    const double omega = 2.0 * std::numbers::pi * frequency, zeta = step.plan.damping_ratio;
    contact.target = -contact.gap * omega / (2.0 * zeta + step.h * omega);
    contact.max_push = -contact.gap * step.h * omega * omega / std::max(contact.response, fastest);
  }
  if (std::ranges::find(contact.points, step.held) != contact.points.end()) {
    double drive = 0.0;  // [m/s]
    for (int c = 0; c < 4; ++c)
      if (contact.points[c] == step.held) drive += contact.weight[c] * glm::dot(contact.normal, step.u[step.held]);
    const double approach = contact.target - glm::dot(contact.normal, relative(contact, step.u));
    contact.max_impulse = contact::max_leverage * std::max(std::abs(drive), approach) / fastest;
  }
  surface.push_back(contact);
}

void SurfaceContacts::sweep(const Step& step, int count, std::span<Vec3> velocity) {
  for (int sweep = 0; sweep < count; ++sweep) {
    for (std::size_t k = 0; k < surface.size(); ++k)
      solve(surface[sweep % 2 == 0 ? k : surface.size() - 1 - k], step.inverse_mass, step.plan.friction, velocity);
    for (ObstacleContact& contact : obstacles) solve(contact, step.inverse_mass, velocity);
  }
  impulses += count * static_cast<long>(surface.size());
}

// The impulses of the same contacts in the last substep. Pairs of points, and points on obstacles, are in ascending order, and pairs of
// features in that of their list; if that is another one, they are found by their points.
void SurfaceContacts::recall(const Step& step) {
  const double factor = last_h_ > 0.0 ? step.h / last_h_ : 0.0;
  const auto use = [&](auto& contact, const ContactImpulses& last, ContactImpulse& end) {
    contact.impulse = scaled(last.path, factor, contact.normal);
    end = scaled(last.end, factor, contact.normal);
  };
  const auto by_points = [](const Memory& memory) { return std::pair(memory.kind, memory.points); };
  const auto in_list = [](const auto& each) { return std::pair(each.kind, each.pair); };
  const bool is_same_list = list_ == last_list_;
  if (!is_same_list) std::ranges::sort(last_, {}, by_points);
  auto next = last_.begin();
  auto next_points = last_points_.begin();
  for (std::size_t k = 0; k < surface.size(); ++k) {
    SurfaceContact& contact = surface[k];
    if (contact.pair == no_index) {
      while (next_points != last_points_.end() && next_points->points < contact.points) ++next_points;
      if (next_points != last_points_.end() && next_points->points == contact.points) use(contact, next_points->impulses, end_[k]);
      continue;
    }
    if (is_same_list)
      while (next != last_.end() && in_list(*next) < in_list(contact)) ++next;
    else
      next = std::ranges::lower_bound(last_, std::pair(contact.kind, contact.points), {}, by_points);
    if (next != last_.end() && next->kind == contact.kind && next->points == contact.points) use(contact, next->impulses, end_[k]);
  }
  auto next_obstacle = last_obstacles_.begin();
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    ObstacleContact& contact = obstacles[k];
    const std::pair key(contact.point, contact.obstacle);
    while (next_obstacle != last_obstacles_.end() && next_obstacle->key < key) ++next_obstacle;
    if (next_obstacle != last_obstacles_.end() && next_obstacle->key == key) use(contact, next_obstacle->impulses, obstacle_end_[k]);
  }
}

void SurfaceContacts::remember(const Step& step) {
  last_.clear();
  last_points_.clear();
  last_obstacles_.clear();
  const auto impulses_of = [](const auto& contact) {
    const ContactImpulse &path = contact.path_impulse, &all = contact.impulse;
    return ContactImpulses{path, {all.normal - path.normal, all.friction - path.friction}};
  };
  const auto has_any = [](const auto& contact) { return contact.impulse.normal > 0.0 || contact.path_impulse.normal > 0.0; };
  for (const SurfaceContact& contact : surface)
    if (has_any(contact))
      (contact.pair == no_index ? last_points_ : last_).push_back({contact.kind, contact.pair, contact.points, impulses_of(contact)});
  for (const ObstacleContact& contact : obstacles)
    if (has_any(contact)) last_obstacles_.push_back({{contact.point, contact.obstacle}, impulses_of(contact)});
  last_list_ = list_;
  last_h_ = step.h;
}

void SurfaceContacts::solve_paths(const Step& step, std::span<Vec3> u) {
  end_.assign(surface.size(), {});
  obstacle_end_.assign(obstacles.size(), {});
  for (ObstacleContact& contact : obstacles) contact.target = contact.path_velocity - std::max(0.0, contact.gap) / step.h;
  recall(step);
  for (const SurfaceContact& contact : surface)
    if (contact.impulse.normal > 0.0) apply(contact, total(contact.impulse, contact.normal), step.inverse_mass, u);
  for (const ObstacleContact& contact : obstacles)
    if (contact.impulse.normal > 0.0) u[contact.point] += step.inverse_mass[contact.point] * total(contact.impulse, contact.normal);
  sweep(step, last_h_ > 0.0 ? contact::sweeps : contact::first_sweeps, u);
  for (SurfaceContact& contact : surface) contact.path_impulse = contact.impulse;
  for (ObstacleContact& contact : obstacles) contact.path_impulse = contact.impulse;
}

// The contacts where their features are at the end of the paths.
void SurfaceContacts::move(const Step& step, std::span<const Vec3> u) {
  end_x_.resize(step.x.size());
  for (std::size_t k = 0; k < end_x_.size(); ++k) end_x_[k] = step.x[k] + step.h * u[k];
  for (std::size_t from = 0; from < surface.size(); from += static_cast<std::size_t>(block_.count)) {
    const FeaturePair kind = surface[from].kind;
    for (block_.count = 0; block_.count < FeatureBlock::capacity; ++block_.count) {
      const std::size_t k = from + static_cast<std::size_t>(block_.count);
      if (k == surface.size() || surface[k].kind != kind) break;
      block_.points[block_.count] = surface[k].points;
    }
    find_closest(kind, end_x_, block_);
    for (int i = 0; i < block_.count; ++i) {
      SurfaceContact& contact = surface[from + static_cast<std::size_t>(i)];
      const Closest closest = block_.closest(i);
      contact.gap = closest.distance - contact.thickness;
      if (!(closest.distance > 0.0)) continue;
      contact.weight = closest.weight;
      contact.normal = closest.separation / closest.distance;
      contact.response = 0.0;
      for (int c = 0; c < 4; ++c) contact.response += closest.weight[c] * closest.weight[c] * step.inverse_mass[contact.points[c]];
    }
  }
}

// Impulses act along the line between the features at the end of the path, where they touch there.
void SurfaceContacts::solve_ends(const Step& step, std::span<const Vec3> u, std::span<Vec3> velocity) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double touching = contact::coincident * step.plan.max_thickness;
  // sets the target, continues from the impulse of the last substep, and returns what that changes
  const auto begin = [&](auto& contact, double gap, double response, double target, const ContactImpulse& end) {
    const bool touches = (contact.impulse.normal > 0.0 || gap <= touching) && response > 0.0;
    contact.target = touches ? target : -infinity;
    if (!touches || end.normal == 0.0) return Vec3(0.0);
    const ContactImpulse before = contact.impulse;
    contact.impulse = {std::max(0.0, before.normal + end.normal), before.friction + end.friction};
    return (contact.impulse.normal - before.normal) * contact.normal + (contact.impulse.friction - before.friction);
  };
  move(step, u);
  for (std::size_t k = 0; k < surface.size(); ++k) {
    SurfaceContact& contact = surface[k];
    contact.max_push = infinity;
    const Vec3 change = begin(contact, contact.gap, contact.response, contact.rebound, end_[k]);
    if (change != Vec3(0.0)) apply(contact, change, step.inverse_mass, velocity);
  }
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    ObstacleContact& contact = obstacles[k];
    const double gap = contact.gap + step.h * (glm::dot(contact.normal, u[contact.point]) - contact.path_velocity);
    velocity[contact.point] += step.inverse_mass[contact.point] * begin(contact, gap, 1.0, contact.end_velocity, obstacle_end_[k]);
  }
  sweep(step, last_h_ > 0.0 ? contact::sweeps : contact::first_sweeps, velocity);
  remember(step);
}

}  // namespace hooke
