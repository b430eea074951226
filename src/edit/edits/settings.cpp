#include <algorithm>

#include "edit/edits/edits.h"
#include "formats/texture.h"
#include "scene/parameters.h"

namespace hooke {
namespace {

bool is_valid(const Force& force) {
  return force.term != nullptr && std::all_of(force.values.begin(), force.values.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

Inverse Apply::operator()(const SetParameter& set) {
  const Inverse inverse = inverse_of(*set.parameter);
  set.parameter->write(scene, clamp_to(*set.parameter, set.value));
  effect.values = effect.values || set.parameter->scope != Parameter::Scope::Setting;
  return inverse;
}

// The commands that restore what a write of the parameter overwrites.
Inverse Apply::inverse_of(const Parameter& parameter) const {
  const auto all_springs = [&](SpringProperty property, double Spring::*member) {
    SetSpringProperty set{property, {}};
    for (const Spring& spring : scene.system.springs()) set.values.emplace_back(spring.id, spring.*member);
    return Inverse{set};
  };
  const auto all_points = [&](PointProperty property, double Point::*member) {
    SetPointProperty set{property, {}};
    for (const Point& point : scene.system.points()) set.values.emplace_back(point.id, point.*member);
    return set;
  };
  switch (parameter.scope) {
    case Parameter::Scope::Gravity:
      return {SetGravity{scene.system.gravity}};
    case Parameter::Scope::Colliders:
      return {SetColliders{carried_colliders(scene.system, scene.state)}};
    case Parameter::Scope::SpringStiffness:
      return all_springs(SpringProperty::Stiffness, &Spring::stiffness);
    case Parameter::Scope::SpringDamping:
      return all_springs(SpringProperty::Damping, &Spring::damping);
    case Parameter::Scope::PointMass:
      return {all_points(PointProperty::Mass, &Point::mass)};
    case Parameter::Scope::PointSize:
      return {all_points(PointProperty::Radius, &Point::radius), all_points(PointProperty::Mass, &Point::mass)};
    case Parameter::Scope::Number:
    case Parameter::Scope::Setting:
      break;
  }
  return {RestoreParameter{&parameter, parameter.read(scene)}};
}

Inverse Apply::operator()(const RestoreParameter& restore) {
  const Inverse inverse = inverse_of(*restore.parameter);
  restore.parameter->write(scene, restore.value);
  effect.values = effect.values || restore.parameter->scope != Parameter::Scope::Setting;
  return inverse;
}

Inverse Apply::operator()(const SetIntegrator& set) {
  const SetIntegrator inverse{scene.settings.integrator};
  scene.settings.integrator = set.integrator;
  return {inverse};
}

Inverse Apply::operator()(const SetGravity& set) {
  const SetGravity inverse{scene.system.gravity};
  if (is_finite(set.gravity)) scene.system.gravity = in_plane(scene.system, set.gravity);
  effect.values = true;
  return {inverse};
}

Inverse Apply::operator()(const SetColliders& set) {
  const SetColliders inverse{carried_colliders(scene.system, scene.state)};
  scene.system.colliders = set.colliders;
  if (auto& carried = scene.state.hand.collider) {
    const auto c = static_cast<std::size_t>(carried->collider);
    if (c < set.colliders.size())
      carried->shape = set.colliders[c].shape;
    else
      carried.reset();
  }
  effect.values = true;
  return {inverse};
}

Inverse Apply::operator()(const SetForces& set) {
  const SetForces inverse{scene.system.forces};
  scene.system.forces.clear();
  for (const Force& force : set.forces)
    if (is_valid(force)) scene.system.forces.push_back(force);
  effect.values = true;
  return {inverse};
}

Inverse Apply::operator()(const SetTexture& set) {
  const SetTexture inverse{scene.view.texture, scene.view.texture_size, {.picture = nullptr, .restored = scene.cloth_texture}};
  scene.view.texture = set.texture;
  scene.view.texture_size = set.size;
  if (set.image.restored) {
    scene.cloth_texture = *set.image.restored;
  } else {
    scene.cloth_texture.picture = set.image.picture;
    set_print_layout(scene);
  }
  return {inverse};
}

}  // namespace hooke
