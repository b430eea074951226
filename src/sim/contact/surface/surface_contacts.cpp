#include "sim/contact/surface/surface_contacts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <ranges>
#include <tuple>

#include "sim/contact/constants.h"

namespace hooke {
namespace {

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
inline void solve(SurfaceContact& contact, std::span<const double> inverse_mass, std::span<Vec3> velocity) {
  const Vec3 v = relative(contact, velocity);
  const double normal_velocity = glm::dot(contact.normal, v);
  if (contact.impulse.normal == 0.0 && !(normal_velocity < contact.target)) return;
  double impulse = contact.impulse.normal + (contact.target - normal_velocity) * contact.mass;
  if (contact.target > 0.0)
    impulse = std::min(impulse, std::max(contact.max_push, contact.impulse.normal - normal_velocity * contact.mass));
  const Vec3 slip = v - normal_velocity * contact.normal;
  apply(
      contact,
      change_impulse(contact.impulse, std::clamp(impulse, 0.0, contact.max_impulse), contact.normal, contact.friction, slip, contact.mass),
      inverse_mass, velocity);
}

// The contacts of features, and those of obstacles, which come last.
std::size_t count_features(std::span<const SurfaceContact> contacts) {
  const auto end = std::ranges::partition_point(contacts, [](const SurfaceContact& each) { return !each.is_on_obstacle(); });
  return static_cast<std::size_t>(end - contacts.begin());
}

SurfaceKey key_of(const SurfaceContact& contact) {
  const Index i = contact.points[0];
  return {contact.kind, contact.pair, contact.is_on_obstacle() ? std::array{i, i, no_index, contact.pair} : contact.points};
}

}  // namespace

void SurfaceContacts::begin_frame() {
  last_.clear();
  last_h_ = 0.0;
}

void SurfaceContacts::make(const Step& step, const SurfaceDetection& detection) {
  paths.clear();
  touching.clear();
  list_ = detection.list_number();
  const double slack = contact::slack * step.plan.max_thickness;
  for (const NearFeatures& near : detection.near()) {
    const Closest& closest = near.closest;
    const Vec3 normal = closest.separation / closest.distance;
    const double gap = closest.distance - near.contact;
    if (!(gap + step.h * glm::dot(normal, relative(near.points, closest.weight, step.u)) < slack)) continue;
    SurfaceContact& contact = paths.emplace_back();
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
  add(step, paths.emplace_back(SurfaceContact{.points = {i, i, j, j},
                                              .weight = {1.0, 0.0, -1.0, 0.0},
                                              .normal = separation / length,
                                              .thickness = distance,
                                              .gap = length - distance,
                                              .pair = SurfaceContact::two_points,
                                              .kind = FeaturePair::TwoEdges}));
}

// The mass of the spring that removes overlaps is that of the contact, and never more than what accelerates its points as it says.
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
  if (response == 0.0) return paths.pop_back();
  contact.mass = 1.0 / response;
  contact.friction = step.plan.friction;
  if (contact.gap >= 0.0) {
    contact.target = -contact.gap / step.h;
  } else {
    const SoftConstraint soft = soft_constraint(step.plan, step.h);
    contact.target = -contact.gap * soft.rate;
    contact.max_push = -contact.gap * step.h * soft.stiffness / std::max(response, fastest);
  }
  if (!is_held) return;
  double drive = 0.0;  // [m/s]
  for (int c = 0; c < 4; ++c)
    if (contact.points[c] == step.held) drive += contact.weight[c] * glm::dot(contact.normal, step.u[step.held]);
  const double approach = contact.target - glm::dot(contact.normal, relative(contact, step.u));
  contact.max_impulse = contact::max_leverage * std::max(std::abs(drive), approach) / fastest;
}

// Starts from nothing in the first substep of a frame, and then from the impulses of the last one. Obstacles come last: nothing enters
// them.
void SurfaceContacts::sweep(const Step& step, std::span<SurfaceContact> contacts, std::span<Vec3> velocity) {
  const int count = last_h_ > 0.0 ? contact::sweeps : contact::first_sweeps;
  const std::size_t features = count_features(contacts);
  const auto solve_all = [&](auto&& some) {
    for (SurfaceContact& contact : some) solve(contact, step.inverse_mass, velocity);
  };
  for (int sweep = 0; sweep < count; ++sweep) {
    if (sweep % 2 == 0)
      solve_all(contacts.first(features));
    else
      solve_all(contacts.first(features) | std::views::reverse);
    solve_all(contacts.subspan(features));
  }
  impulses += count * static_cast<long>(features);
}

// The impulses of the same contacts in the last substep, which are in the same order as now. If pairs have been listed again, they are
// found by their points.
void SurfaceContacts::recall(const Step& step) {
  const double factor = last_h_ > 0.0 ? step.h / last_h_ : 0.0;
  const auto by_points = [](const SurfaceKey& key) { return std::tuple(key.kind, key.points); };
  const auto in_list = [](const SurfaceKey& key) { return std::tuple(key.kind, key.pair, key.points); };
  const auto of_points = [&](const SurfaceMemory& each) { return by_points(each.key); };
  const bool is_same_list = list_ == last_list_;
  if (!is_same_list) std::ranges::sort(last_, {}, of_points);
  auto next = last_.begin();
  for (SurfaceContact& contact : paths) {
    const SurfaceKey key = key_of(contact);
    if (is_same_list)
      while (next != last_.end() && in_list(next->key) < in_list(key)) ++next;
    else
      next = std::ranges::lower_bound(last_, by_points(key), {}, of_points);
    if (next == last_.end() || by_points(next->key) != by_points(key)) continue;
    contact.impulse = next->path.scaled(factor, contact.normal);
    contact.last = static_cast<Index>(next - last_.begin());
  }
}

void SurfaceContacts::remember(const Step& step) {
  last_.clear();
  for (std::size_t k = 0; k < touching.size(); ++k) {
    const SurfaceContact& contact = touching[k];
    const ContactImpulse &all = contact.impulse, &path = path_impulses_[k];
    if (all.normal > 0.0 || path.normal > 0.0)
      last_.push_back({key_of(contact), path, {all.normal - path.normal, all.friction - path.friction}});
  }
  last_list_ = list_;
  last_h_ = step.h;
}

void SurfaceContacts::solve_paths(const Step& step, std::span<Vec3> u) {
  recall(step);
  for (const SurfaceContact& contact : paths)
    if (contact.impulse.normal > 0.0) apply(contact, contact.impulse.total(contact.normal), step.inverse_mass, u);
  sweep(step, paths, u);
  // features turn on their way
  const auto may_touch = [&](const SurfaceContact& contact) {
    const double end = contact.gap + step.h * glm::dot(contact.normal, relative(contact, u));
    return end < contact::slack * contact::slack * contact.thickness;
  };
  for (const SurfaceContact& contact : paths)
    if (contact.impulse.normal > 0.0 || may_touch(contact)) touching.push_back(contact);
  for (SurfaceContact& contact : touching) contact.target = 0.0, contact.max_push = std::numeric_limits<double>::infinity();
}

// The contacts where their features are at the end of the paths.
void SurfaceContacts::move(const Step& step, std::span<const Vec3> u) {
  end_x_.resize(step.x.size());
  for (std::size_t k = 0; k < end_x_.size(); ++k) end_x_[k] = step.x[k] + step.h * u[k];
  const auto leave_apart = [](SurfaceContact& contact, double gap) {
    if (contact.impulse.normal == 0.0 && gap > contact::coincident * contact.thickness)
      contact.target = -std::numeric_limits<double>::infinity();
  };
  const std::size_t features = count_features(touching);
  for (SurfaceContact& contact : std::span(touching).subspan(features))
    leave_apart(contact, contact.gap + step.h * glm::dot(contact.normal, relative(contact, u)));
  for (std::size_t from = 0; from < features; from += static_cast<std::size_t>(block_.count)) {
    const FeaturePair kind = touching[from].kind;
    for (block_.count = 0; block_.count < FeatureBlock::capacity; ++block_.count) {
      const std::size_t k = from + static_cast<std::size_t>(block_.count);
      if (k == features || touching[k].kind != kind) break;
      block_.points[block_.count] = touching[k].points;
    }
    find_closest(kind, end_x_, block_);
    for (int i = 0; i < block_.count; ++i) {
      SurfaceContact& contact = touching[from + static_cast<std::size_t>(i)];
      const Closest closest = block_.closest(i);
      leave_apart(contact, closest.distance - contact.thickness);
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
  const double factor = last_h_ > 0.0 ? step.h / last_h_ : 0.0;
  move(step, u);
  path_impulses_.clear();
  for (SurfaceContact& contact : touching) {
    const ContactImpulse before = path_impulses_.emplace_back(contact.impulse);
    if (contact.last == no_index || std::isinf(contact.target)) continue;
    const ContactImpulse end = last_[contact.last].end.scaled(factor, contact.normal);
    if (end.normal == 0.0) continue;
    contact.impulse = {std::max(0.0, before.normal + end.normal), before.friction + end.friction};
    apply(contact, contact.impulse.total(contact.normal) - before.total(contact.normal), step.inverse_mass, velocity);
  }
  sweep(step, touching, velocity);
  remember(step);
}

double SurfaceContacts::max_work(Index first, Index end, std::span<const Vec3> velocity) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < touching.size(); ++k) {
    const SurfaceContact& contact = touching[k];
    const double impulse = (path_impulses_[k].normal + contact.impulse.normal) * (1.0 + contact.friction);
    for (int c = 0; c < 4; ++c)
      if (const Index i = contact.points[c]; i >= first && i < end) sum += std::abs(contact.weight[c]) * impulse * glm::length(velocity[i]);
  }
  return sum;
}

}  // namespace hooke
