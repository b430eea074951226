#include <algorithm>
#include <cmath>
#include <limits>

#include "base/file_limits.h"
#include "base/finite.h"
#include "edit/command.h"
#include "edit/commands/validity.h"
#include "edit/commands/value_text.h"
#include "edit/in_plane.h"
#include "formats/texture.h"
#include "scene/parameters.h"
#include "sim/methods/integrator.h"

namespace hooke {
namespace {

// "set Stiffness k to 185 N/m", "switch Shear springs off", "set Given as to Each spring: k, d"
std::string describe_value(const Parameter& parameter, double value) {
  const std::string label(parameter.label);
  if (parameter.kind == Parameter::Kind::Switch) return "switch " + label + (value != 0.0 ? " on" : " off");
  if (value == 0.0 && !parameter.zero_text.empty()) return "set " + label + " to " + std::string(parameter.zero_text);
  if (parameter.kind != Parameter::Kind::Choice) return "set " + label + " to " + value_text(value, parameter.unit);
  const auto at = static_cast<std::size_t>(std::max(value, 0.0));
  return "set " + label + (at < parameter.choices.size() ? " to " + std::string(parameter.choices[at].label) : "");
}

// The value of a RestoreParameter that removes what was not given before.
constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

void add_effect_of(const Parameter& parameter, Effect& effect) {
  effect.values = effect.values || parameter.scope != Parameter::Scope::Setting;
  effect.structure = effect.structure || parameter.scope == Parameter::Scope::Structure;
}

// The commands that restore what a write of the parameter overwrites.
Inverse inverse_of(const Parameter& parameter, const Scene& scene) {
  const auto all = [](auto set, const auto& items) {
    for (const auto& item : items) set.values.emplace_back(item.id, item.*member_of(set.property));
    return set;
  };
  const auto& springs = scene.system.springs();
  const auto& points = scene.system.points();
  switch (parameter.scope) {
    case Parameter::Scope::Gravity:
      return {SetGravity{scene.system.gravity}};
    case Parameter::Scope::Colliders:
      return {SetColliders{carried_colliders(scene.system, scene.state)}};
    case Parameter::Scope::SpringStiffness:
      return {all(SetSpringProperty{SpringProperty::Stiffness, {}}, springs)};
    case Parameter::Scope::SpringDamping:
      return {all(SetSpringProperty{SpringProperty::Damping, {}}, springs)};
    case Parameter::Scope::PointMass:
      return {all(SetPointProperty{PointProperty::Mass, {}}, points)};
    case Parameter::Scope::PointSize:
      return {all(SetPointProperty{PointProperty::Radius, {}}, points), all(SetPointProperty{PointProperty::Mass, {}}, points)};
    case Parameter::Scope::Number:
    case Parameter::Scope::Setting:
    case Parameter::Scope::Structure:
      break;
  }
  if (!parameter.is_given(scene)) return {RestoreParameter{&parameter, not_given}};
  Inverse inverse{RestoreParameter{&parameter, parameter.read(scene)}};
  // the speed of the muscles changes their offset too
  if (parameter.name == "muscles" || parameter.name == "muscle_speed")
    inverse.push_back(RestoreParameter{find_parameter("muscle_offset"), scene.system.muscles.offset});
  return inverse;
}

Inverse set(const Parameter& parameter, double value, Scene& scene, Effect& effect) {
  Inverse inverse = inverse_of(parameter, scene);
  parameter.write(scene, value);
  if (!is_valid_after(parameter, scene)) {
    for (const Command& command : inverse) std::visit([&](const auto& each) { each.apply(scene, effect); }, command);
    return {};
  }
  add_effect_of(parameter, effect);
  return inverse;
}

}  // namespace

std::string SetParameter::describe() const { return describe_value(*parameter, clamp_to_range(*parameter, value)); }

Inverse SetParameter::apply(Scene& scene, Effect& effect) const {
  return set(*parameter, clamp_to_range(*parameter, value), scene, effect);
}

std::string RestoreParameter::describe() const {
  return std::isnan(value) ? "reset " + std::string(parameter->label) : describe_value(*parameter, value);
}

Inverse RestoreParameter::apply(Scene& scene, Effect& effect) const {
  if (std::isnan(value) && parameter->access.clear != nullptr) {
    Inverse inverse = inverse_of(*parameter, scene);
    parameter->access.clear(scene);
    add_effect_of(*parameter, effect);
    return inverse;
  }
  if (!is_valid(*parameter, value)) return {};
  return set(*parameter, value, scene, effect);
}

std::string SetIntegrator::describe() const { return "use " + std::string(integrator->label); }

Inverse SetIntegrator::apply(Scene& scene, Effect&) const {
  Settings& settings = scene.settings;
  const SetIntegrator inverse{settings.integrator};
  // the tolerance of one adaptive method means something else to another, and nothing to the rest
  const bool was_adaptive = settings.integrator->stability == Stability::Adaptive,
             is_adaptive = integrator->stability == Stability::Adaptive;
  if (!(was_adaptive || is_adaptive) || integrator == settings.integrator || !settings.tolerance) {
    settings.integrator = integrator;
    return {inverse};
  }
  // the inverse drops one too
  const RestoreParameter tolerance{&tolerance_parameter, *settings.tolerance};
  if (was_adaptive) settings.tolerance.reset();
  settings.integrator = integrator;
  return {inverse, tolerance};
}

Inverse SetGravity::apply(Scene& scene, Effect& effect) const {
  if (!is_finite(gravity)) return {};
  const SetGravity inverse{scene.system.gravity};
  scene.system.gravity = in_plane(scene.system, gravity);
  effect.values = true;
  return {inverse};
}

Inverse SetColliders::apply(Scene& scene, Effect& effect) const {
  if (colliders.size() > max_colliders || !std::ranges::all_of(colliders, [](const Collider& collider) { return is_valid(collider); }))
    return {};
  const SetColliders inverse{carried_colliders(scene.system, scene.state)};
  scene.system.colliders = colliders;
  if (auto& carried = scene.state.hand.collider) {
    const auto c = static_cast<std::size_t>(carried->collider);
    if (c < colliders.size())
      carried->shape = colliders[c].shape;
    else
      carried.reset();
  }
  effect.values = true;
  return {inverse};
}

Inverse SetForces::apply(Scene& scene, Effect& effect) const {
  if (forces.size() > max_forces || !std::ranges::all_of(forces, [](const Force& force) { return is_valid(force); })) return {};
  const SetForces inverse{scene.system.forces};
  scene.system.forces = forces;
  effect.values = true;
  return {inverse};
}

Inverse SetText::apply(Scene& scene, Effect&) const {
  const SetText inverse{scene.name, scene.description, scene.notes};
  scene.name = title;
  scene.description = description;
  scene.notes = notes;
  return {inverse};
}

Inverse SetPlots::apply(Scene& scene, Effect&) const { return {SetPlots{std::exchange(scene.view.plots, plots)}}; }

Inverse SetTexture::apply(Scene& scene, Effect&) const {
  if (!is_valid(*this)) return {};
  const SetTexture inverse{scene.view.texture, scene.view.texture_size, {.picture = nullptr, .restored = scene.cloth_texture}};
  scene.view.texture = texture;
  scene.view.texture_size = size;
  if (image.restored) {
    scene.cloth_texture = *image.restored;
  } else {
    scene.cloth_texture.picture = image.picture;
    set_print_layout(scene);
  }
  return {inverse};
}

}  // namespace hooke
