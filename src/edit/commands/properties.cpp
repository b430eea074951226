#include <algorithm>
#include <glm/geometric.hpp>

#include "base/finite.h"
#include "base/text_lines.h"
#include "edit/command.h"
#include "edit/commands/validity.h"
#include "edit/commands/value_text.h"
#include "edit/in_plane.h"

namespace hooke {
namespace {

Point item_at(const System& system, Index i, PointId) { return system.points()[i]; }
Spring item_at(const System& system, Index s, SpringId) { return system.springs()[s]; }
void put(System& system, Index i, const Point& point) { system.point(i) = point; }
void put(System& system, Index s, const Spring& spring) { *system.spring(s) = spring; }

// Sets a member of points or springs wherever they are valid with it. Returns the earlier values, the last one first.
template <class Id, class Value, class Item>
std::vector<std::pair<Id, Value>> exchange(Scene& scene, const std::vector<std::pair<Id, Value>>& values, Value Item::*member) {
  std::vector<std::pair<Id, Value>> earlier;
  for (const auto& [id, value] : values) {
    const Index i = scene.system.index_of(id);
    if (i == no_index) continue;
    Item changed = item_at(scene.system, i, id);
    earlier.emplace_back(id, std::exchange(changed.*member, value));
    is_valid(changed) ? put(scene.system, i, changed) : earlier.pop_back();
  }
  std::ranges::reverse(earlier);
  return earlier;
}

}  // namespace

std::string SetNailed::describe() const {
  const bool nailed = !items.empty() && items.front().nailed;
  return (nailed ? "nail " : "release ") + pluralize(items.size(), "point", "points");
}

Inverse SetNailed::apply(Scene& scene, Effect& effect) const {
  SetNailed inverse;
  for (const SetNailed::Item& item : items) {
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

std::string Move::describe() const { return "move " + pluralize(items.size(), "point", "points"); }

bool Move::is_undone_with(const Move& earlier) const { return std::ranges::equal(items, earlier.items, {}, &Item::point, &Item::point); }

Inverse Move::apply(Scene& scene, Effect& effect) const {
  Move inverse;
  for (const Move::Item& item : items) {
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

std::string SetVelocity::describe() const {
  return "velocity of " + pluralize(values.size(), "point", "points") +
         (values.size() == 1 ? " to " + value_text(glm::length(values[0].second), "m/s") : "");
}

Inverse SetVelocity::apply(Scene& scene, Effect& effect) const {
  SetVelocity inverse;
  for (const auto& [point, velocity] : values) {
    const Index i = scene.system.index_of(point);
    if (i == no_index || scene.system.points()[i].nailed || !is_finite(velocity)) continue;
    inverse.values.emplace_back(point, scene.state.velocity[i]);
    scene.state.velocity[i] = in_plane(scene.system, velocity);
  }
  std::reverse(inverse.values.begin(), inverse.values.end());
  effect.motion = true;
  return {inverse};
}

std::string SetPointColor::describe() const { return "color of " + pluralize(values.size(), "point", "points"); }

Inverse SetPointColor::apply(Scene& scene, Effect&) const { return {SetPointColor{exchange(scene, values, &Point::color)}}; }

std::string SetLoad::describe() const {
  return "load of " + pluralize(values.size(), "point", "points") +
         (values.size() == 1 ? " to " + value_text(glm::length(values[0].second), "N") : "");
}

Inverse SetLoad::apply(Scene& scene, Effect& effect) const {
  effect.values = true;
  return {SetLoad{exchange(scene, values, &Point::load)}};
}

std::string SetFixedAxes::describe() const {
  const std::string axes = values.empty() ? "" : axes_text(values[0].second);
  return (axes.empty() ? "free " : "fix " + axes + " of ") + pluralize(values.size(), "point", "points");
}

Inverse SetFixedAxes::apply(Scene& scene, Effect& effect) const {
  effect.values = true;
  return {SetFixedAxes{exchange(scene, values, &Point::fixed_axes)}};
}

std::string SetPointProperty::describe() const {
  const bool is_mass = property == PointProperty::Mass;
  return (is_mass ? "mass of " : "radius of ") + pluralize(values.size(), "point", "points") +
         new_values_text(values, is_mass ? "kg" : "m");
}

Inverse SetPointProperty::apply(Scene& scene, Effect& effect) const {
  double Point::*const member = member_of(property);
  SetPointProperty inverse{property, {}};
  // where mass follows the radius, restore it after the radius
  SetPointProperty masses{PointProperty::Mass, {}};
  const bool follows = property == PointProperty::Radius && scene.defaults.mass_follows_radius;
  for (const auto& [point, value] : values) {
    const Index i = scene.system.index_of(point);
    if (i == no_index) continue;
    const Point now = scene.system.points()[i];
    Point changed = now;
    changed.*member = value;
    if (follows) changed.mass = mass_at_radius(now, value);
    if (!is_valid(changed)) continue;
    inverse.values.emplace_back(point, now.*member);
    if (follows) masses.values.emplace_back(point, now.mass);
    scene.system.point(i) = changed;
  }
  std::reverse(inverse.values.begin(), inverse.values.end());
  std::reverse(masses.values.begin(), masses.values.end());
  effect.values = true;
  if (follows) return {inverse, masses};
  return {inverse};
}

std::string SetSpringProperty::describe() const {
  constexpr const char* what[] = {"stiffness of ", "damping of ", "rest length of ", "break strain of "};
  constexpr const char* units[] = {"N/m", "N s/m", "m", ""};
  const auto at = static_cast<int>(property);
  return what[at] + pluralize(values.size(), "spring", "springs") + new_values_text(values, units[at]);
}

Inverse SetSpringProperty::apply(Scene& scene, Effect& effect) const {
  effect.values = true;
  return {SetSpringProperty{property, exchange(scene, values, member_of(property))}};
}

std::string SetSpringLaw::describe() const { return "law of " + pluralize(values.size(), "spring", "springs"); }

Inverse SetSpringLaw::apply(Scene& scene, Effect& effect) const {
  effect.values = true;
  return {SetSpringLaw{exchange(scene, values, &Spring::law)}};
}

}  // namespace hooke
