#include "ui/panels/mixed_values.h"

#include <algorithm>

namespace hooke {
namespace {

using Scope = Parameter::Scope;

bool is_of_springs(const Parameter& row) { return row.scope == Scope::SpringStiffness || row.scope == Scope::SpringDamping; }

// Calls `use(spring, weight)` for each spring that the row sets.
template <class Use>
void for_springs(const Parameter& row, const System& system, const SheetWeights* sheet, const AffectedSprings& affected, const Use& use) {
  const auto visit = [&](const Spring& spring) {
    if (const double weight = weight_of(row, sheet, spring); weight > 0.0) use(spring, weight);
  };
  if (affected.all)
    for (const Spring& spring : system.springs()) visit(spring);
  for (const SpringId id : affected.selected)
    if (const Index s = system.index_of(id); s != no_index) visit(system.springs()[s]);
}

}  // namespace

bool has_many_values(const Parameter& row) {
  // a sheet without points still has a density, and a scene without points a radius
  return is_of_springs(row) || row.scope == Scope::Colliders;
}

CommonValue values_of(const Parameter& row, const System& system, const SheetWeights* sheet, const AffectedSprings& affected) {
  CommonValue common;
  if (is_of_springs(row))
    for_springs(row, system, sheet, affected,
                [&](const Spring& spring, double weight) { common.include(spring.*row.springs.property / weight); });
  if (row.scope == Scope::PointMass)
    for (const Point& point : system.points())
      if (const double area = area_of(sheet, point.id); area > 0.0) common.include(point.mass / area);
  if (row.scope == Scope::PointSize)
    for (const Point& point : system.points()) common.include(point.radius);
  if (row.scope == Scope::Colliders)
    for (const Collider& collider : system.colliders)
      if (collider.solid) common.include(collider.*row.collider);
  return common;
}

std::optional<Command> scaled_values(const Parameter& row, const System& before, const System& now, const SheetWeights* sheet,
                                     const AffectedSprings& affected, double mean) {
  const double mean_before = values_of(row, before, sheet, affected).value_or(0.0);
  if (!(mean_before > 0.0)) return std::nullopt;
  const double factor = mean / mean_before;

  if (is_of_springs(row)) {
    SetSpringProperty set{row.scope == Scope::SpringStiffness ? SpringProperty::Stiffness : SpringProperty::Damping, {}};
    for_springs(row, before, sheet, affected,
                [&](const Spring& spring, double) { set.values.emplace_back(spring.id, factor * (spring.*row.springs.property)); });
    return set;
  }
  if (row.scope == Scope::PointMass) {
    SetPointProperty set{PointProperty::Mass, {}};
    for (const Point& point : before.points())
      if (area_of(sheet, point.id) > 0.0) set.values.emplace_back(point.id, factor * point.mass);
    return set;
  }
  if (row.scope == Scope::PointSize) {
    SetPointProperty set{PointProperty::Radius, {}};
    for (const Point& point : before.points()) set.values.emplace_back(point.id, factor * point.radius);
    return set;
  }
  if (row.scope == Scope::Colliders && before.colliders.size() == now.colliders.size()) {
    SetColliders set{now.colliders};
    for (std::size_t c = 0; c < set.colliders.size(); ++c)
      set.colliders[c].*row.collider = std::clamp(factor * (before.colliders[c].*row.collider), row.min, row.max);
    return set;
  }
  return std::nullopt;
}

}  // namespace hooke
