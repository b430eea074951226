// What points carry, as forces without a field of their own in scene files: their loads, and what holds rollers on their axes.

#include <algorithm>
#include <glm/geometric.hpp>

#include "sim/plan/plan.h"

namespace hooke {
namespace {

void add_loads(const Plan& plan, const ForceValues&, double, const double*, const double*, double* f) {
  for (const auto& [i, load] : plan.force_data.load) add_vector(plan, f, i, load);
}

ForceBound bound_loads(const System& system, const Plan& prepared, const ForceValues&, double) {
  ForceBound bound;
  for (const auto& [i, load] : prepared.force_data.load)
    bound.acceleration = std::max(bound.acceleration, glm::length(load) / system.points()[i].mass);
  return bound;
}

// U = -sum F.x
double potential_of_loads(const Plan& plan, const ForceValues&, double, const double* x) {
  double energy = 0.0;
  for (const auto& [i, load] : plan.force_data.load)
    if (plan.inverse_mass[i] != 0.0) energy -= glm::dot(load, vector_at(plan, x, i));
  return energy;
}

void hold_rollers(const Plan& plan, const ForceValues&, double, const double*, const double*, double* f) { clear_fixed_axes(plan, f); }

// They project the derivative of the other forces, whose eigenvalues do not grow by that.
ForceBound bound_rollers(const System&, const Plan&, const ForceValues&, double) { return {}; }

}  // namespace

constinit const ForceTerm load_force{
    .id = "load",
    .rank = 0,
    .label = "Loads",
    .description = "The loads of points.",
    .numbers = {},
    .add = add_loads,
    .bound = bound_loads,
    .potential = potential_of_loads,
};

constinit const ForceTerm roller_force{
    .id = "fixed",
    .label = "Rollers",
    .description = "What holds points on their axes.",
    .numbers = {},
    .add = hold_rollers,
    .bound = bound_rollers,
};

}  // namespace hooke
