#include "sim/contact/surface/surface_contacts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <ranges>
#include <tuple>

#include "sim/contact/constants.h"

namespace hooke {
namespace {

// In the memory of impulses, of two points that touch each other.
constexpr Index pair_of_points = std::numeric_limits<Index>::max();

// Of the first feature, as seen from the second.
inline Vec3 relative(const std::array<Index, 4>& points, const std::array<double, 4>& w, std::span<const Vec3> field) {
  const auto& [i, j, k, l] = points;
  return w[0] * field[i] + w[1] * field[j] + w[2] * field[k] + w[3] * field[l];
}
inline Vec3 relative(const SurfaceContact& contact, std::span<const Vec3> field) { return relative(contact.points, contact.weight, field); }

inline void apply(const SurfaceContact& contact, const Vec3& impulse, std::span<const double> inverse_mass, std::span<Vec3> velocity) {
  for (int c = 0; c < 4; ++c) velocity[contact.points[c]] += inverse_mass[contact.points[c]] * contact.weight[c] * impulse;
}

// The impulse that reaches the target. What separates is pushed by no more than a spring would; what approaches is stopped in any case.
inline void solve(SurfaceContact& contact, std::span<const double> inverse_mass, double friction, std::span<Vec3> velocity) {
  const Vec3 v = relative(contact, velocity);
  const double normal_velocity = glm::dot(contact.normal, v);
  if (contact.impulse.normal == 0.0 && !(normal_velocity < contact.target)) return;
  double impulse = contact.impulse.normal + (contact.target - normal_velocity) * contact.mass;
  if (contact.target > 0.0)
    impulse = std::min(impulse, std::max(contact.max_push, contact.impulse.normal - normal_velocity * contact.mass));
  const Vec3 slip = v - normal_velocity * contact.normal;
  apply(contact,
        change_impulse(contact.impulse, std::clamp(impulse, 0.0, contact.max_impulse), contact.normal, friction, slip, contact.mass),
        inverse_mass, velocity);
}

void solve(ObstacleContact& contact, std::span<const double> inverse_mass, std::span<Vec3> velocity) {
  Vec3& v = velocity[contact.point];
  const double response = inverse_mass[contact.point], normal_velocity = glm::dot(contact.normal, v);
  if (contact.impulse.normal == 0.0 && !(normal_velocity < contact.target)) return;
  const double impulse = std::max(0.0, contact.impulse.normal + (contact.target - normal_velocity) / response);
  const Vec3 relative = v - contact.surface, slip = relative - glm::dot(contact.normal, relative) * contact.normal;
  v += response * change_impulse(contact.impulse, impulse, contact.normal, contact.friction, slip, 1.0 / response);
}

Vec3 across(const Vec3& normal, const Vec3& w) { return w - glm::dot(normal, w) * normal; }

ContactImpulse scaled(const ContactImpulse& impulse, double factor, const Vec3& normal) {
  return {factor * impulse.normal, factor * across(normal, impulse.friction)};
}
Vec3 total(const ContactImpulse& impulse, const Vec3& normal) { return impulse.normal * normal + impulse.friction; }

}  // namespace

void SurfaceContacts::begin_frame() {
  last_.clear();
  last_obstacles_.clear();
  last_h_ = 0.0;
}

void SurfaceContacts::make(const Step& step, const SurfaceDetection& detection) {
  surface.clear();
  touching.clear();
  obstacles.clear();
  list_ = detection.list_number();
  const double slack = contact::slack * step.plan.max_thickness;
  for (const SurfaceDetection::Near& near : detection.near()) {
    const Closest& closest = near.closest;
    const Vec3 normal = closest.separation / closest.distance;
    const double gap = closest.distance - near.contact;
    if (!(gap + step.h * glm::dot(normal, relative(near.points, closest.weight, step.u)) < slack)) continue;
    SurfaceContact& contact = surface.emplace_back();
    contact.points = near.points;
    contact.weight = closest.weight;
    contact.normal = normal;
    contact.thickness = near.contact;
    contact.gap = gap;
    contact.pair = near.pair;
    contact.kind = near.kind;
    add(step, contact);
  }
}

void SurfaceContacts::add_points(const Step& step, Index i, Index j, double distance) {
  const Vec3 separation = step.x[i] - step.x[j];
  const double length = glm::length(separation);
  if (length <= contact::coincident * distance) return;
  add(step, surface.emplace_back(SurfaceContact{.points = {i, i, j, j},
                                                .weight = {1.0, 0.0, -1.0, 0.0},
                                                .normal = separation / length,
                                                .thickness = distance,
                                                .gap = length - distance,
                                                .pair = pair_of_points,
                                                .kind = FeaturePair::TwoEdges}));
}

// Overlaps are removed by the velocity omega / (2 zeta + h omega) times the overlap, which is the bias of a soft constraint with frequency
// omega and damping ratio zeta (E. Catto, Box2D v3, b2MakeSoft), and by no more than the force of its spring. Unlike there, what approaches
// is stopped by any force: the constraint is rigid in that direction. The mass of the spring is that of the contact, and never more than
// what accelerates its points by omega^2 times the overlap.
//
// An impulse J on weights w that changes x1 by h J w / m and v1 by J w / m adds the angular momentum sum w (x1 - h v1) x J. So its
// direction is that of sum w (x1 - h v1), which is the line between the closest points for methods with x1 = x0 + h v1, and nearly that for
// others.
//
// Of the last contact, which goes again if nothing can move its points.
void SurfaceContacts::add(const Step& step, SurfaceContact& contact) {
  if (step.plan.friction == 0.0) {
    const Vec3 arm = relative(contact, step.arm);
    const double length = std::sqrt(glm::dot(arm, arm));
    constexpr double min_cosine = 0.9;
    if (glm::dot(arm, contact.normal) > min_cosine * length) contact.normal = arm / length;
  }
  double response = 0.0, fastest = 0.0;  // [1/kg], relative velocity per impulse, and that of the fastest point
  bool is_held = false;
  for (int c = 0; c < 4; ++c) {
    const double change = contact.weight[c] * step.inverse_mass[contact.points[c]];
    response += contact.weight[c] * change;
    fastest = std::max(fastest, std::abs(change));
    is_held = is_held || contact.points[c] == step.held;
  }
  if (response == 0.0) return surface.pop_back();
  contact.mass = 1.0 / response;
  if (contact.gap >= 0.0) {
    contact.target = -contact.gap / step.h;
  } else {
    const double frequency = std::min(step.plan.frequency, contact::max_frequency / step.h);
    const double omega = 2.0 * std::numbers::pi * frequency, zeta = step.plan.damping_ratio;
    contact.target = -contact.gap * omega / (2.0 * zeta + step.h * omega);
    contact.max_push = -contact.gap * step.h * omega * omega / std::max(response, fastest);
  }
  if (!is_held) return;
  double drive = 0.0;  // [m/s]
  for (int c = 0; c < 4; ++c)
    if (contact.points[c] == step.held) drive += contact.weight[c] * glm::dot(contact.normal, step.u[step.held]);
  const double approach = contact.target - glm::dot(contact.normal, relative(contact, step.u));
  contact.max_impulse = contact::max_leverage * std::max(std::abs(drive), approach) / fastest;
}

// Starts from nothing in the first substep of a frame, and then from the impulses of the last one.
void SurfaceContacts::sweep(const Step& step, std::span<SurfaceContact> contacts, std::span<Vec3> velocity) {
  const int count = last_h_ > 0.0 ? contact::sweeps : contact::first_sweeps;
  for (int sweep = 0; sweep < count; ++sweep) {
    if (sweep % 2 == 0)
      for (SurfaceContact& contact : contacts) solve(contact, step.inverse_mass, step.plan.friction, velocity);
    else
      for (SurfaceContact& contact : contacts | std::views::reverse) solve(contact, step.inverse_mass, step.plan.friction, velocity);
    for (ObstacleContact& contact : obstacles) solve(contact, step.inverse_mass, velocity);
  }
  impulses += count * static_cast<long>(contacts.size());
}

// The impulses of the same contacts in the last substep, which are in the same order as now. If pairs have been listed again, they are
// found by their points.
void SurfaceContacts::recall(const Step& step) {
  const double factor = last_h_ > 0.0 ? step.h / last_h_ : 0.0;
  const auto by_points = [](const auto& each) { return std::tuple(each.kind, each.points); };
  const auto in_list = [](const auto& each) { return std::tuple(each.kind, each.pair, each.points); };
  const bool is_same_list = list_ == last_list_;
  if (!is_same_list) std::ranges::sort(last_, {}, by_points);
  auto next = last_.begin();
  for (SurfaceContact& contact : surface) {
    if (is_same_list)
      while (next != last_.end() && in_list(*next) < in_list(contact)) ++next;
    else
      next = std::ranges::lower_bound(last_, by_points(contact), {}, by_points);
    if (next == last_.end() || by_points(*next) != by_points(contact)) continue;
    contact.impulse = scaled(next->impulses.path, factor, contact.normal);
    contact.last = static_cast<Index>(next - last_.begin());
  }
  recall_obstacles(factor);
}

void SurfaceContacts::recall_obstacles(double factor) {
  obstacle_end_.assign(obstacles.size(), {});
  auto next = last_obstacles_.begin();
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    ObstacleContact& contact = obstacles[k];
    const std::pair key(contact.point, contact.obstacle);
    while (next != last_obstacles_.end() && next->key < key) ++next;
    if (next == last_obstacles_.end() || next->key != key) continue;
    contact.impulse = scaled(next->impulses.path, factor, contact.normal);
    obstacle_end_[k] = scaled(next->impulses.end, factor, contact.normal);
  }
}

void SurfaceContacts::remember(const Step& step) {
  last_.clear();
  last_obstacles_.clear();
  const auto without = [](const ContactImpulse& all, const ContactImpulse& path) {
    return ContactImpulses{path, {all.normal - path.normal, all.friction - path.friction}};
  };
  for (std::size_t k = 0; k < touching.size(); ++k) {
    const SurfaceContact& contact = touching[k];
    if (contact.impulse.normal > 0.0 || path_impulses_[k].normal > 0.0)
      last_.push_back({contact.kind, contact.pair, contact.points, without(contact.impulse, path_impulses_[k])});
  }
  for (const ObstacleContact& contact : obstacles)
    if (contact.impulse.normal > 0.0 || contact.path_impulse.normal > 0.0)
      last_obstacles_.push_back({{contact.point, contact.obstacle}, without(contact.impulse, contact.path_impulse)});
  last_list_ = list_;
  last_h_ = step.h;
}

void SurfaceContacts::solve_paths(const Step& step, std::span<Vec3> u) {
  for (ObstacleContact& contact : obstacles) contact.target = contact.path_velocity - std::max(0.0, contact.gap) / step.h;
  recall(step);
  for (const SurfaceContact& contact : surface)
    if (contact.impulse.normal > 0.0) apply(contact, total(contact.impulse, contact.normal), step.inverse_mass, u);
  for (const ObstacleContact& contact : obstacles)
    if (contact.impulse.normal > 0.0) u[contact.point] += step.inverse_mass[contact.point] * total(contact.impulse, contact.normal);
  sweep(step, surface, u);
  // features turn on their way
  const auto may_touch = [&](const SurfaceContact& contact) {
    const double end = contact.gap + step.h * glm::dot(contact.normal, relative(contact, u));
    return end < contact::slack * contact::slack * contact.thickness;
  };
  for (const SurfaceContact& contact : surface)
    if (contact.impulse.normal > 0.0 || may_touch(contact)) touching.push_back(contact);
  for (SurfaceContact& contact : touching) contact.target = 0.0, contact.max_push = std::numeric_limits<double>::infinity();
  for (ObstacleContact& contact : obstacles) contact.path_impulse = contact.impulse;
}

// The contacts where their features are at the end of the paths.
void SurfaceContacts::move(const Step& step, std::span<const Vec3> u) {
  end_x_.resize(step.x.size());
  for (std::size_t k = 0; k < end_x_.size(); ++k) end_x_[k] = step.x[k] + step.h * u[k];
  for (std::size_t from = 0; from < touching.size(); from += static_cast<std::size_t>(block_.count)) {
    const FeaturePair kind = touching[from].kind;
    for (block_.count = 0; block_.count < FeatureBlock::capacity; ++block_.count) {
      const std::size_t k = from + static_cast<std::size_t>(block_.count);
      if (k == touching.size() || touching[k].kind != kind) break;
      block_.points[block_.count] = touching[k].points;
    }
    find_closest(kind, end_x_, block_);
    for (int i = 0; i < block_.count; ++i) {
      SurfaceContact& contact = touching[from + static_cast<std::size_t>(i)];
      const Closest closest = block_.closest(i);
      const double gap = closest.distance - contact.thickness;
      if (contact.impulse.normal == 0.0 && gap > contact::coincident * contact.thickness)
        contact.target = -std::numeric_limits<double>::infinity();
      double response = 0.0;
      for (int c = 0; c < 4; ++c) response += closest.weight[c] * closest.weight[c] * step.inverse_mass[contact.points[c]];
      if (!(closest.distance > 0.0) || response == 0.0) continue;
      contact.weight = closest.weight;
      contact.normal = closest.separation / closest.distance;
      contact.mass = 1.0 / response;
    }
  }
}

// Impulses act along the line between the features at the end of the path, where they touch there. They continue from those of the last
// substep.
void SurfaceContacts::solve_ends(const Step& step, std::span<const Vec3> u, std::span<Vec3> velocity) {
  const double factor = last_h_ > 0.0 ? step.h / last_h_ : 0.0, close = contact::coincident * step.plan.max_thickness;
  // returns the change of the impulse
  const auto continue_from = [](const ContactImpulse& end, auto& contact) {
    if (end.normal == 0.0) return Vec3(0.0);
    const ContactImpulse before = contact.impulse;
    contact.impulse = {std::max(0.0, before.normal + end.normal), before.friction + end.friction};
    return (contact.impulse.normal - before.normal) * contact.normal + (contact.impulse.friction - before.friction);
  };
  move(step, u);
  path_impulses_.clear();
  for (SurfaceContact& contact : touching) {
    path_impulses_.push_back(contact.impulse);
    if (contact.last == no_index || std::isinf(contact.target)) continue;
    const Vec3 change = continue_from(scaled(last_[contact.last].impulses.end, factor, contact.normal), contact);
    if (change != Vec3(0.0)) apply(contact, change, step.inverse_mass, velocity);
  }
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    ObstacleContact& contact = obstacles[k];
    const double gap = contact.gap + step.h * (glm::dot(contact.normal, u[contact.point]) - contact.path_velocity);
    const bool touches = contact.impulse.normal > 0.0 || gap <= close;
    contact.target = touches ? contact.end_velocity : -std::numeric_limits<double>::infinity();
    if (touches) velocity[contact.point] += step.inverse_mass[contact.point] * continue_from(obstacle_end_[k], contact);
  }
  sweep(step, touching, velocity);
  remember(step);
}

double SurfaceContacts::impulses_on(Index point) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < touching.size(); ++k)
    for (int c = 0; c < 4; ++c)
      if (touching[k].points[c] == point) sum += std::abs(touching[k].weight[c]) * (path_impulses_[k].normal + touching[k].impulse.normal);
  return sum;
}

}  // namespace hooke
