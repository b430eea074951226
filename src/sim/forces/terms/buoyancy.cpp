// f = -b m g: a constant lift, the fraction b of the weight.
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/terms/rows.h"
#include "sim/plan/plan.h"

namespace hooke {
namespace {

constexpr ForceParameter numbers[] = {{"lift", "Lift", "of the weight", 0.0, 2.0, 0.5}};

void add(const Plan& plan, const ForceValues& values, double, const double*, const double*, double* f) {
  for (Index i = 0; i < plan.points; ++i) add_vector(plan, f, i, -values[0] * plan.mass[i] * plan.gravity);
}

ForceBound bound(const System& system, const Plan&, const ForceValues& values, double) {
  return {.acceleration = std::abs(values[0]) * glm::length(system.gravity)};
}

// U = b m g.x
double potential(const Plan& plan, const ForceValues& values, double, const double* x) {
  double energy = 0.0;
  for (Index i = 0; i < plan.points; ++i)
    if (plan.inverse_mass[i] != 0.0) energy += values[0] * plan.mass[i] * glm::dot(plan.gravity, vector_at(plan, x, i));
  return energy;
}

}  // namespace

constinit const ForceTerm buoyancy_force{
    .id = "buoyancy",
    .rank = 3,
    .label = "Buoyancy",
    .description = "A constant lift, as a fraction of the weight.",
    .numbers = numbers,
    .add = add,
    .bound = bound,
    .potential = potential,
};

}  // namespace hooke
