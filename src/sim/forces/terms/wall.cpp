// a = s / r^p away from every plane, r the distance of the surface of the point from it, but at least r0.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/forces/force_tangent.h"
#include "sim/forces/terms/power_law.h"
#include "sim/forces/terms/rows.h"
#include "sim/model/portable_math.h"
#include "sim/plan/plan.h"

namespace hooke {
namespace {

constexpr ForceParameter numbers[] = {
    {"strength", "Strength at 1 m", "m/s^2", -1000.0, 1000.0, 1.0},
    {"power", "Exponent", "", 0.0, 4.0, 1.0},
    {"core", "Minimum distance", "m", 1e-6, 10.0, 0.01},
};

// For every plane and point: use(normal, i, distance of the surface of the point).
template <class Use>
void for_each_distance(const Plan& plan, double time, const double* x, const Use& use) {
  const std::size_t n = plan.points;
  const auto visit = [&](const Plane& plane, const Vec3& offset, double min_distance) {
    const double height = glm::dot(plane.normal, plane.point + offset);
    for (std::size_t i = 0; i < n; ++i) {
      const double distance = glm::dot(plane.normal, vector_at(plan, x, static_cast<Index>(i))) - height - plan.radius[i];
      if (distance >= min_distance) use(plane.normal, static_cast<Index>(i), distance);
    }
  };
  for (std::size_t k = 0; k < plan.colliders.size(); ++k)
    if (const auto* plane = std::get_if<Plane>(&plan.colliders[k].shape))
      visit(*plane, plan.offset_of(k, time), -std::numeric_limits<double>::infinity());
  // not from behind
  for (const Collider& wall : plan.one_way) visit(std::get<Plane>(wall.shape), Vec3(0.0), 0.0);
}

void add(const Plan& plan, const ForceValues& values, double time, const double* x, const double*, double* f) {
  for_each_distance(plan, time, x, [&](const Vec3& normal, Index i, double distance) {
    const double push = plan.mass[i] * values[0] / portable::pow(std::max(distance, values[2]), values[1]);
    add_vector(plan, f, i, push * normal);
  });
}

// |da/dr| <= |s| p / r0^(p+1) along each normal; of several planes, times the largest eigenvalue of sum n n^T, which is at most the
// largest row of the matrix |n_i . n_j|
ForceBound bound(const System& system, const Plan&, const ForceValues& values, double) {
  std::vector<Vec3> normals;
  for (const Collider& collider : system.colliders)
    if (const auto* plane = std::get_if<Plane>(&collider.shape); plane != nullptr && collider.solid) normals.push_back(plane->normal);
  double gain = 0.0;
  for (const Vec3& a : normals) {
    double row = 0.0;
    for (const Vec3& b : normals) row += std::abs(glm::dot(a, b));
    gain = std::max(gain, row);
  }
  const double at_core = std::abs(values[0]) * portable::pow(values[2], -values[1]);
  const double stiffness = gain * at_core * values[1] / values[2];
  return {.stiffness = stiffness,
          .acceleration = static_cast<double>(normals.size()) * at_core,
          .omitted_stiffness = values[0] < 0.0 ? stiffness : 0.0};
}

void add_tangent(const Plan& plan, const ForceValues& values, double time, const double* x, const double*, ForceTangent& tangent) {
  for_each_distance(plan, time, x, [&](const Vec3& normal, Index i, double distance) {
    if (distance > values[2])
      tangent.add_stiffness(i, normal, plan.mass[i] * values[0] * values[1] * portable::pow(distance, -values[1] - 1.0), 0.0);
  });
}

// minus the integral of a to the distance
double potential(const Plan& plan, const ForceValues& values, double time, const double* x) {
  const double power = values[1], core = values[2];
  double energy = 0.0;
  for_each_distance(plan, time, x, [&](const Vec3&, Index i, double distance) {
    if (plan.inverse_mass[i] == 0.0) return;
    const double integral = distance > core ? power_law_potential(power, core, distance)
                                            : power_law_potential(power, core, core) + (distance - core) * portable::pow(core, -power);
    energy -= plan.mass[i] * values[0] * integral;
  });
  return energy;
}

}  // namespace

constinit const ForceTerm wall_force{
    .id = "wall",
    .rank = 6,
    .label = "Wall repulsion",
    .description = "Repels every point from every plane, with an acceleration that falls with a power of the distance.",
    .numbers = numbers,
    .add = add,
    .bound = bound,
    .add_tangent = add_tangent,
    .potential = potential,
    .cost =
        [](const Plan& plan, const ForceValues& values) {
          return cost_of_power_law(values[1], static_cast<double>(plan.colliders.size() + plan.one_way.size()));
        },
};

}  // namespace hooke
