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

bool SurfaceContact::weigh(std::span<const double> inverse_mass) {
  double response = 0.0;  // [1/kg], relative velocity per impulse
  for (int c = 0; c < 4; ++c) response += weight[c] * weight[c] * inverse_mass[points[c]];
  if (response == 0.0) return false;
  law.mass = 1.0 / response;
  return true;
}

double SurfaceContact::fastest(std::span<const double> inverse_mass) const {
  double max = 0.0;
  for (int c = 0; c < 4; ++c) max = std::max(max, std::abs(weight[c]) * inverse_mass[points[c]]);
  return max;
}

void SurfaceContact::limit(std::span<const double> inverse_mass, Index held, std::span<const Vec3> u) {
  if (held == no_index || std::ranges::find(points, held) == points.end()) return;
  double drive = 0.0;  // [m/s]
  for (int c = 0; c < 4; ++c)
    if (points[c] == held) drive += weight[c] * glm::dot(law.normal, u[held]);
  const double approach = law.target - glm::dot(law.normal, relative(u));
  law.max_impulse = contact::max_leverage * std::max(std::abs(drive), approach) / fastest(inverse_mass);
}

void SurfaceContacts::begin_frame() {
  last_.clear();
  last_h_ = 0.0;
}

void SurfaceContacts::make(const Step& step, const SurfaceDetection& detection) {
  all.clear();
  list_ = detection.list_number();
  const double slack = contact::slack * step.plan.max_thickness;
  for (const NearFeatures& near : detection.near()) {
    const Vec3 normal = near.closest.separation / near.closest.distance;
    const double gap = near.closest.distance - near.contact;
    if (!(gap + step.h * glm::dot(normal, relative_vector(near.points, near.closest.weight, step.u)) < slack)) continue;
    SurfaceContact& contact = all.emplace_back();
    contact.points = near.points;
    contact.weight = near.closest.weight;
    contact.law.normal = normal;
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
  add(step, all.emplace_back(SurfaceContact{.points = {i, i, j, j},
                                            .weight = {1.0, 0.0, -1.0, 0.0},
                                            .law = {.normal = separation / length},
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
    const Vec3 arm = contact.relative(step.arm);
    const double length = std::sqrt(glm::dot(arm, arm));
    constexpr double min_cosine = 0.9;
    if (glm::dot(arm, contact.law.normal) > min_cosine * length) contact.law.normal = arm / length;
  }
  if (!contact.weigh(step.inverse_mass)) return all.pop_back();
  contact.law.friction = step.plan.friction;
  if (contact.gap >= 0.0) {
    contact.law.target = -contact.gap / step.h;
  } else {
    const SoftConstraint soft = soft_constraint(step.plan, step.h);
    contact.law.target = -contact.gap * soft.rate;
    contact.law.max_push = -contact.gap * step.h * soft.stiffness / std::max(1.0 / contact.law.mass, contact.fastest(step.inverse_mass));
  }
  contact.limit(step.inverse_mass, step.held, step.u);
}

// Starts from nothing in the first substep of a frame, and then from the impulses of the last one. Obstacles come last: nothing enters
// them.
void SurfaceContacts::sweep(const Step& step, std::span<SurfaceContact> contacts, std::span<Vec3> velocity) {
  const int count = last_h_ > 0.0 ? contact::sweeps : contact::first_sweeps;
  const std::size_t features = count_features(contacts);
  const auto solve = [&](SurfaceContact& contact) {
    if (const Vec3 impulse = contact.law.solve(contact.relative(velocity)); impulse != Vec3(0.0))
      contact.apply(impulse, step.inverse_mass, velocity);
  };
  // forward and backward in turn
  for (int sweep = 0; sweep < count; ++sweep) {
    for (std::size_t k = 0; k < features; ++k) solve(contacts[sweep % 2 == 0 ? k : features - 1 - k]);
    for (SurfaceContact& obstacle : contacts.subspan(features)) solve(obstacle);
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
  for (SurfaceContact& contact : all) {
    const SurfaceKey key = key_of(contact);
    if (is_same_list)
      while (next != last_.end() && in_list(next->key) < in_list(key)) ++next;
    else
      next = std::ranges::lower_bound(last_, by_points(key), {}, of_points);
    if (next == last_.end() || by_points(next->key) != by_points(key)) continue;
    contact.law.impulse = next->path.scaled(factor, contact.law.normal);
    contact.last = static_cast<Index>(next - last_.begin());
  }
}

void SurfaceContacts::remember(const Step& step) {
  last_.clear();
  for (std::size_t k = 0; k < all.size(); ++k) {
    const SurfaceContact& contact = all[k];
    const ContactImpulse &total = contact.law.impulse, &path = path_impulses_[k];
    if (total.normal > 0.0 || path.normal > 0.0)
      last_.push_back({key_of(contact), path, {total.normal - path.normal, total.friction - path.friction}});
  }
  last_list_ = list_;
  last_h_ = step.h;
}

void SurfaceContacts::solve_paths(const Step& step, std::span<Vec3> u) {
  recall(step);
  for (const SurfaceContact& contact : all)
    if (contact.law.impulse.normal > 0.0) contact.apply(contact.law.impulse.total(contact.law.normal), step.inverse_mass, u);
  sweep(step, all, u);
  // features turn on their way
  std::erase_if(all, [&](const SurfaceContact& contact) {
    const double end = contact.gap + step.h * glm::dot(contact.law.normal, contact.relative(u));
    return contact.law.impulse.normal == 0.0 && !(end < contact::slack * contact::slack * contact.thickness);
  });
  for (SurfaceContact& contact : all) contact.law.target = 0.0, contact.law.max_push = std::numeric_limits<double>::infinity();
}

// The contacts where their features are at the end of the paths.
void SurfaceContacts::move(const Step& step, std::span<const Vec3> u) {
  end_x_.resize(step.x.size());
  for (std::size_t k = 0; k < end_x_.size(); ++k) end_x_[k] = step.x[k] + step.h * u[k];
  const auto leave_apart = [](SurfaceContact& contact, double gap) {
    if (contact.law.impulse.normal == 0.0 && gap > contact::coincident * contact.thickness)
      contact.law.target = -std::numeric_limits<double>::infinity();
  };
  const std::size_t features = count_features(all);
  for (SurfaceContact& contact : std::span(all).subspan(features))
    leave_apart(contact, contact.gap + step.h * glm::dot(contact.law.normal, contact.relative(u)));
  for (std::size_t from = 0; from < features; from += static_cast<std::size_t>(block_.count)) {
    const FeaturePair kind = all[from].kind;
    for (block_.count = 0; block_.count < FeatureBlock::capacity; ++block_.count) {
      const std::size_t k = from + static_cast<std::size_t>(block_.count);
      if (k == features || all[k].kind != kind) break;
      block_.points[block_.count] = all[k].points;
    }
    find_closest(kind, end_x_, block_);
    for (int i = 0; i < block_.count; ++i) {
      SurfaceContact& contact = all[from + static_cast<std::size_t>(i)];
      const Closest closest = block_.closest(i);
      leave_apart(contact, closest.distance - contact.thickness);
      if (!(closest.distance > 0.0)) continue;
      contact.weight = closest.weight;
      contact.law.normal = closest.separation / closest.distance;
      contact.weigh(step.inverse_mass);
    }
  }
}

// Impulses act along the line between the features at the end of the path, where they touch there. They continue from those of the last
// substep.
void SurfaceContacts::solve_ends(const Step& step, std::span<const Vec3> u, std::span<Vec3> velocity) {
  const double factor = last_h_ > 0.0 ? step.h / last_h_ : 0.0;
  move(step, u);
  path_impulses_.clear();
  for (SurfaceContact& contact : all) {
    const ContactImpulse before = path_impulses_.emplace_back(contact.law.impulse);
    if (contact.last == no_index || std::isinf(contact.law.target)) continue;
    const ContactImpulse end = last_[contact.last].end.scaled(factor, contact.law.normal);
    if (end.normal == 0.0) continue;
    contact.law.impulse = {std::max(0.0, before.normal + end.normal), before.friction + end.friction};
    contact.apply(contact.law.impulse.total(contact.law.normal) - before.total(contact.law.normal), step.inverse_mass, velocity);
  }
  sweep(step, all, velocity);
  remember(step);
}

}  // namespace hooke
