#include "lab/reset_parameters.h"

#include "scene/parameters.h"

namespace hooke {
namespace {

// Adds the command that sets a member to what it was, where it differs, or everywhere. False: there is nothing to set.
template <class Set, class Items, class Item, class Value>
bool add(Set set, Value Item::*member, const Items& now, const Items& opened, const System& system, std::vector<Command>& commands,
         bool everywhere = false) {
  for (const Item& item : now) {
    const Index i = system.index_of(item.id);
    if (i == no_index) continue;
    const Item earlier = opened[i];
    if (everywhere || earlier.*member != item.*member) set.values.emplace_back(item.id, earlier.*member);
  }
  if (set.values.empty()) return false;
  commands.emplace_back(std::move(set));
  return true;
}

}  // namespace

std::vector<Command> commands_to_reset_parameters(const Scene& now, const Scene& opened) {
  std::vector<Command> commands;
  if (now.settings.integrator != opened.settings.integrator) commands.emplace_back(SetIntegrator{opened.settings.integrator});
  for (const Parameter& row : parameters()) {
    const bool is_one_value = row.scope == Parameter::Scope::Number || row.scope == Parameter::Scope::Setting;
    if (const double value = row.read(opened); is_one_value && value != row.read(now)) commands.emplace_back(RestoreParameter{&row, value});
  }
  if (now.system.gravity != opened.system.gravity) commands.emplace_back(SetGravity{opened.system.gravity});
  if (now.system.forces != opened.system.forces) commands.emplace_back(SetForces{opened.system.forces});

  std::vector<Collider> colliders = carried_colliders(now.system, now.state);
  if (const auto& list = opened.system.colliders; list.size() == colliders.size()) {
    bool differs = false;
    for (const Parameter& row : parameters()) {
      if (row.scope != Parameter::Scope::Colliders) continue;
      for (std::size_t c = 0; c < colliders.size(); ++c) {
        differs = differs || colliders[c].*row.collider != list[c].*row.collider;
        colliders[c].*row.collider = list[c].*row.collider;
      }
    }
    if (differs) commands.emplace_back(SetColliders{std::move(colliders)});
  }

  const auto add_points = [&](PointProperty property, bool everywhere) {
    const SetPointProperty set{property, {}};
    return add(set, member_of(property), now.system.points(), opened.system.points(), opened.system, commands, everywhere);
  };
  const auto add_springs = [&](const auto& set, auto member) {
    add(set, member, now.system.springs(), opened.system.springs(), opened.system, commands);
  };
  // radii before masses, which may follow them
  const bool sets_radii = add_points(PointProperty::Radius, false);
  add_points(PointProperty::Mass, sets_radii && opened.defaults.mass_follows_radius);
  if (now.system.springs().have_laws() || opened.system.springs().have_laws()) add_springs(SetSpringLaw{}, &Spring::law);
  for (const auto property : {SpringProperty::Stiffness, SpringProperty::Damping, SpringProperty::RestLength, SpringProperty::BreakStrain})
    add_springs(SetSpringProperty{property, {}}, member_of(property));
  return commands;
}

}  // namespace hooke
