#include <algorithm>

#include "edit/edits/edits.h"

namespace hooke {

bool is_valid(const Point& point) {
  return point.mass > 0.0 && std::isfinite(point.mass) && point.radius >= 0.0 && std::isfinite(point.radius);
}

bool is_valid(const Spring& spring) {
  return spring.first != spring.second && spring.stiffness >= 0.0 && std::isfinite(spring.stiffness) && spring.damping >= 0.0 &&
         std::isfinite(spring.damping) && spring.rest_length >= 0.0 && std::isfinite(spring.rest_length) && spring.break_strain > 0.0;
}

Inverse Apply::operator()(const SetNailed& set) {
  SetNailed inverse;
  for (const SetNailed::Item& item : set.items) {
    const Index i = scene.system.index_of(item.point);
    if (i == no_index || scene.system.points()[i].nailed == item.nailed) continue;
    inverse.items.push_back({item.point, !item.nailed, scene.state.velocity[i]});
    scene.system.point(i).nailed = item.nailed;
    scene.state.velocity[i] = is_finite(item.velocity) ? in_plane(scene.system, item.velocity) : Vec3(0.0);
  }
  std::reverse(inverse.items.begin(), inverse.items.end());
  effect.values = true;
  return {inverse};
}

Inverse Apply::operator()(const Move& move) {
  Move inverse;
  for (const Move::Item& item : move.items) {
    const Index i = scene.system.index_of(item.point);
    if (i == no_index || !is_finite(item.position) || !is_finite(item.velocity)) continue;
    inverse.items.push_back({item.point, scene.state.position[i], scene.state.velocity[i]});
    scene.state.position[i] = in_plane(scene.system, item.position);
    scene.state.velocity[i] = in_plane(scene.system, item.velocity);
  }
  std::reverse(inverse.items.begin(), inverse.items.end());
  effect.motion = true;
  return {inverse};
}

Inverse Apply::operator()(const SetPointColor& set) {
  SetPointColor inverse;
  for (const auto& [id, color] : set.values) {
    const Index i = scene.system.index_of(id);
    if (i == no_index) continue;
    inverse.values.emplace_back(id, scene.system.points()[i].color);
    scene.system.point(i).color = color;
  }
  std::reverse(inverse.values.begin(), inverse.values.end());
  return {inverse};
}

Inverse Apply::operator()(const SetPointProperty& set) {
  double Point::*const property = set.property == PointProperty::Mass ? &Point::mass : &Point::radius;
  SetPointProperty inverse{set.property, {}};
  // where mass follows the radius, restore it after the radius
  SetPointProperty masses{PointProperty::Mass, {}};
  const bool follows = set.property == PointProperty::Radius && scene.defaults.mass_follows_radius;
  for (const auto& [id, value] : set.values) {
    const Index i = scene.system.index_of(id);
    if (i == no_index) continue;
    const Point now = scene.system.points()[i];
    Point changed = now;
    changed.*property = value;
    if (follows) changed.mass = mass_at_radius(now, value);
    if (!is_valid(changed)) continue;
    inverse.values.emplace_back(id, now.*property);
    if (follows) masses.values.emplace_back(id, now.mass);
    scene.system.point(i) = changed;
  }
  std::reverse(inverse.values.begin(), inverse.values.end());
  std::reverse(masses.values.begin(), masses.values.end());
  effect.values = true;
  if (follows) return {inverse, masses};
  return {inverse};
}

Inverse Apply::operator()(const SetSpringProperty& set) {
  constexpr double Spring::*properties[] = {&Spring::stiffness, &Spring::damping, &Spring::rest_length, &Spring::break_strain};
  double Spring::*const property = properties[static_cast<int>(set.property)];
  SetSpringProperty inverse{set.property, {}};
  inverse.values.reserve(set.values.size());
  for (const auto& [id, value] : set.values) {
    const Index s = scene.system.index_of(id);
    if (s == no_index) continue;
    Spring changed = scene.system.springs()[s];
    changed.*property = value;
    if (!is_valid(changed)) continue;
    inverse.values.emplace_back(id, scene.system.springs()[s].*property);
    scene.system.spring(s) = changed;
  }
  std::reverse(inverse.values.begin(), inverse.values.end());
  effect.values = true;
  return {inverse};
}

}  // namespace hooke
