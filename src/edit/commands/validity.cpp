#include "edit/commands/validity.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/bounds.h"
#include "base/finite.h"
#include "base/overloaded.h"
#include "formats/texture.h"
#include "scene/parameters.h"
#include "scene/spring_laws.h"

namespace hooke {
namespace {

bool is_within(const Bounds& bounds, double value) { return std::isfinite(value) && bounds.contains(value); }

bool is_valid(const ColliderShape& shape) {
  return std::visit(
      Overloaded{
          [](const Plane& plane) {
            constexpr double round_off = 1e-14;
            return is_finite(plane.point) && is_finite(plane.normal) && std::abs(glm::length(plane.normal) - 1.0) <= round_off;
          },
          [](const Sphere& sphere) { return is_finite(sphere.center) && is_within(positive, sphere.radius); },
          [](const Box& box) {
            return is_finite(box.min) && is_finite(box.max) && box.min.x < box.max.x && box.min.y < box.max.y && box.min.z < box.max.z;
          },
      },
      shape);
}

// A box that turns, or a plane that tilts, would be another shape at every time.
bool may_spin(const Collider& collider) {
  const Vec3& spin = collider.path.spin;
  if (spin == Vec3(0.0)) return true;
  if (const auto* plane = std::get_if<Plane>(&collider.shape))
    return glm::length(glm::cross(spin, plane->normal)) <= 1e-9 * glm::length(spin);
  return std::holds_alternative<Sphere>(collider.shape);
}

}  // namespace

bool is_valid(const Point& point) {
  return is_within(positive, point.mass) && is_within(not_negative, point.radius) && point.fixed_axes < 8 && is_finite(point.load);
}

bool is_valid(const Spring& spring) {
  const bool breaks = spring.break_strain != never_breaks;
  return spring.first != spring.second && is_within(not_negative, spring.stiffness) && is_within(not_negative, spring.damping) &&
         is_within(not_negative, spring.rest_length) && error_of(spring).limit.empty() &&
         (!breaks || is_within(positive, spring.break_strain));
}

bool is_valid(const Face& face) {
  const auto& [a, b, c] = face.points;
  constexpr Bounds half_turn{.min = -3.141592653589793, .max = 3.141592653589793};
  return a != b && b != c && c != a && std::ranges::all_of(face.rest_angle, [&](double angle) { return is_within(half_turn, angle); });
}

bool is_valid(const Collider& collider) {
  const ColliderPath& path = collider.path;
  return is_valid(collider.shape) && is_within({.min = 0.0, .max = 1.0}, collider.restitution) &&
         is_within(not_negative, collider.friction) && is_finite(path.amplitude) && is_within(not_negative, path.frequency) &&
         std::isfinite(path.phase) && is_finite(path.spin) && is_finite(path.belt) && may_spin(collider);
}

bool is_valid(const PairContact& contact) {
  return is_within(not_negative, contact.thickness) && is_within({.min = 0.0, .max = 1.0}, contact.restitution) &&
         is_within(not_negative, contact.friction) && is_within(positive, contact.frequency) && is_within(positive, contact.damping_ratio);
}

bool is_valid(const Force& force) {
  if (force.term == nullptr) return false;
  for (std::size_t i = 0; i < force.values.size(); ++i) {
    const bool is_used = i < force.term->numbers.size();
    if (is_used && !force.term->numbers[i].choices.empty()) {
      const double count = static_cast<double>(force.term->numbers[i].choices.size());
      if (!(force.values[i] >= 0.0 && force.values[i] < count && force.values[i] == std::floor(force.values[i]))) return false;
      continue;
    }
    if (!is_within(is_used ? force.term->numbers[i].valid() : any_number, force.values[i])) return false;
  }
  return true;
}

bool is_valid(const SetTexture& set) { return texture_limit(set.texture).empty() && (!set.size || is_within(positive, *set.size)); }

bool is_valid(const Parameter& parameter, double value) {
  if (!is_within(parameter.physical, value)) return false;
  switch (parameter.kind) {
    case Parameter::Kind::Number:
      return true;
    case Parameter::Kind::Integer:
      return value == std::round(value);
    case Parameter::Kind::Switch:
      return value == 0.0 || value == 1.0;
    case Parameter::Kind::Choice:
      return value == std::round(value) && value >= 0.0 && value < static_cast<double>(parameter.choices.size());
  }
  return false;
}

bool is_valid_after(const Parameter& parameter, const Scene& scene) {
  using enum Parameter::Scope;
  const System& system = scene.system;
  switch (parameter.scope) {
    case Gravity:
      return is_finite(system.gravity);
    case Colliders:
      return std::ranges::all_of(system.colliders, [](const Collider& collider) { return is_valid(collider); });
    case SpringStiffness:
    case SpringDamping:
      return std::ranges::all_of(system.springs(), [](const Spring& spring) { return is_valid(spring); });
    case PointMass:
    case PointSize:
      return std::ranges::all_of(system.points(), [](const Point& point) { return is_valid(point); });
    case Number:
    case Setting:
    case Structure:
      return true;
  }
  return false;
}

}  // namespace hooke
