// a = -(p X + q V) / M, the same for every point: X the center of mass of the points that are not nailed relative to a target, V its
// velocity, M their mass. A point that is the target is none of them.
#include <glm/geometric.hpp>

#include "sim/forces/force_tangent.h"
#include "sim/forces/terms/rows.h"
#include "sim/plan/plan.h"

namespace hooke {
namespace {

constexpr ForceParameter numbers[] = {
    {"x", "Target x", "m", -100.0, 100.0, 0.0},        {"y", "Target y", "m", -100.0, 100.0, 0.0},
    {"z", "Target z", "m", -100.0, 100.0, 0.0},        {"stiffness", "Stiffness", "N/m", 0.0, 1000.0, 10.0},
    {"damping", "Damping", "N s/m", 0.0, 1000.0, 2.0},
};

// 0 for nailed points and the target. A held point counts.
double counted_mass(const Plan& plan, Index i) {
  if (i == plan.force_data.center) return 0.0;
  if (plan.hand.held == i) return plan.hand.held_mass;
  return plan.inverse_mass[i] == 0.0 ? 0.0 : plan.mass[i];
}

double total_mass(const Plan& plan) {
  double mass = 0.0;
  for (Index i = 0; i < plan.points; ++i) mass += counted_mass(plan, i);
  return mass;
}

// Mean of a field, weighted by mass.
Vec3 mean(const Plan& plan, const double* field, double mass) {
  Vec3 sum(0.0);
  for (Index i = 0; i < plan.points; ++i) sum += counted_mass(plan, i) * vector_at(plan, field, i);
  return sum / mass;
}

// X
Vec3 offset_of(const Plan& plan, const ForceValues& values, const double* x, double mass) {
  const Index center = plan.force_data.center;
  return mean(plan, x, mass) -
         (center == no_index ? Vec3(values[0], values[1], plan.dimensions == 3 ? values[2] : 0.0) : vector_at(plan, x, center));
}

void add(const Plan& plan, const ForceValues& values, double, const double* x, const double* v, double* f) {
  const double mass = total_mass(plan);
  if (mass == 0.0) return;
  const Vec3 acceleration = -(values[3] * offset_of(plan, values, x, mass) + values[4] * mean(plan, v, mass)) / mass;
  for (Index i = 0; i < plan.points; ++i) add_vector(plan, f, i, counted_mass(plan, i) * acceleration);
}

// M^-1/2 (df/dx) M^-1/2 = -p / M^2 w w^T, w_i = sqrt(m_i) for the free points and 0 for others
ForceBound bound(const System& system, const Plan&, const ForceValues& values, double) {
  double mass = 0.0;
  for (const Point& point : system.points()) mass += point.nailed || point.id == system.center_point ? 0.0 : point.mass;
  if (mass == 0.0) return {};
  return {.stiffness = values[3] / mass, .rate = values[4] / mass};
}

void add_tangent(const Plan& plan, const ForceValues& values, double, const double*, const double*, ForceTangent& tangent) {
  const double mass = total_mass(plan);
  if (mass > 0.0) tangent.add_mean(values[3] / (mass * mass), values[4] / (mass * mass));
}

double potential(const Plan& plan, const ForceValues& values, double, const double* x) {
  const double mass = total_mass(plan);
  if (mass == 0.0) return 0.0;
  const Vec3 offset = offset_of(plan, values, x, mass);
  return 0.5 * values[3] * glm::dot(offset, offset);
}

double power(const Plan& plan, const ForceValues& values, double, const double* x, const double* v) {
  const double mass = total_mass(plan);
  if (mass == 0.0) return 0.0;
  Vec3 free_momentum(0.0);
  for (Index i = 0; i < plan.points; ++i)
    if (plan.inverse_mass[i] != 0.0 && i != plan.force_data.center) free_momentum += plan.mass[i] * vector_at(plan, v, i);
  const double by_target = plan.force_data.center == no_index
                               ? 0.0
                               : values[3] * glm::dot(offset_of(plan, values, x, mass), vector_at(plan, v, plan.force_data.center));
  return -values[4] * glm::dot(mean(plan, v, mass), free_momentum) / mass - by_target;
}

}  // namespace

constinit const ForceTerm mass_center_force{
    .id = "mass_center",
    .rank = 5,
    .label = "Pull on center of mass",
    .description = "Accelerates all points that are not nailed equally so that their center of mass moves to a target.",
    .numbers = numbers,
    .depends_on_velocity = true,
    .add = add,
    .bound = bound,
    .add_tangent = add_tangent,
    .potential = potential,
    .power = power,
    .cost = [](const Plan&, const ForceValues&) { return ForceCost{.evaluation = 1.0, .energy = 12.0}; },
};

}  // namespace hooke
