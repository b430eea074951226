// a = s / r^p away from every plane, r the distance of the point's rim from it, not below r0.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/terms/rows.h"
#include "sim/plan.h"

namespace hooke {
namespace {

constexpr ForceParameter numbers[] = {
    {"strength", "Strength at 1 m", "m/s^2", -1000.0, 1000.0, 1.0},
    {"power", "Falls with power", "", 0.0, 4.0, 1.0},
    {"core", "Least distance", "m", 1e-6, 10.0, 0.01},
};

void add(const Plan& plan, const ForceValues& values, double time, const double* x, const double*, double* f) {
  const std::size_t n = plan.points;
  for (std::size_t k = 0; k < plan.colliders.size(); ++k) {
    const auto* plane = std::get_if<Plane>(&plan.colliders[k].shape);
    if (plane == nullptr) continue;
    const double height = glm::dot(plane->normal, plane->point + plan.offset_of(k, time));
    for (std::size_t i = 0; i < n; ++i) {
      double distance = -height - plan.radius[i];
      for (int c = 0; c < plan.dimensions; ++c) distance += plane->normal[c] * x[c * n + i];
      const double push = plan.mass[i] * values[0] / std::pow(std::max(distance, values[2]), values[1]);
      for (int c = 0; c < plan.dimensions; ++c) f[c * n + i] += push * plane->normal[c];
    }
  }
}

}  // namespace

constinit const ForceTerm wall_force{
    .id = "wall",
    .label = "Push off walls",
    .description = "Pushes every point off every plane, with an acceleration that falls with a power of the distance.",
    .numbers = numbers,
    .add = add,
};

}  // namespace hooke
