#include "lab/reset_parameters.h"

#include <cmath>

#include "scene/parameters.h"

namespace hooke {
namespace {

enum class Which { Different, All };

// False: nothing to set.
bool add_points(PointProperty property, double Point::*member, Which which, const System& now, const System& opened,
                std::vector<Command>& commands) {
  SetPointProperty set{property, {}};
  for (const Point& point : now.points()) {
    const Index i = opened.index_of(point.id);
    if (i != no_index && (which == Which::All || opened.points()[i].*member != point.*member))
      set.values.emplace_back(point.id, opened.points()[i].*member);
  }
  if (set.values.empty()) return false;
  commands.emplace_back(std::move(set));
  return true;
}

void add_springs(SpringProperty property, double Spring::*member, const System& now, const System& opened, std::vector<Command>& commands) {
  SetSpringProperty set{property, {}};
  for (const Spring& spring : now.springs()) {
    const Index s = opened.index_of(spring.id);
    if (s != no_index && opened.springs()[s].*member != spring.*member) set.values.emplace_back(spring.id, opened.springs()[s].*member);
  }
  if (!set.values.empty()) commands.emplace_back(std::move(set));
}

void add_laws(const System& now, const System& opened, std::vector<Command>& commands) {
  SetSpringLaw set;
  if (!now.springs().have_laws() && !opened.springs().have_laws()) return;
  for (const Spring& spring : now.springs()) {
    const Index s = opened.index_of(spring.id);
    if (s != no_index && opened.springs()[s].law != spring.law) set.values.emplace_back(spring.id, opened.springs()[s].law);
  }
  if (!set.values.empty()) commands.emplace_back(std::move(set));
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

  // radii before masses, which may follow them
  const bool sets_radii = add_points(PointProperty::Radius, &Point::radius, Which::Different, now.system, opened.system, commands);
  const bool masses_follow = sets_radii && opened.defaults.mass_follows_radius;
  add_points(PointProperty::Mass, &Point::mass, masses_follow ? Which::All : Which::Different, now.system, opened.system, commands);
  add_laws(now.system, opened.system, commands);
  add_springs(SpringProperty::Stiffness, &Spring::stiffness, now.system, opened.system, commands);
  add_springs(SpringProperty::Damping, &Spring::damping, now.system, opened.system, commands);
  add_springs(SpringProperty::RestLength, &Spring::rest_length, now.system, opened.system, commands);
  add_springs(SpringProperty::BreakStrain, &Spring::break_strain, now.system, opened.system, commands);
  return commands;
}

}  // namespace hooke
