// a = -(p X + q V) / M, the same for every point: X the centre of mass from a place, V its velocity, M the mass of all.
#include "sim/forces/terms/rows.h"
#include "sim/plan.h"

namespace hooke {
namespace {

constexpr ForceParameter numbers[] = {
    {"x", "Place x", "m", -100.0, 100.0, 0.0},         {"y", "Place y", "m", -100.0, 100.0, 0.0},
    {"z", "Place z", "m", -100.0, 100.0, 0.0},         {"stiffness", "Stiffness", "N/m", 0.0, 1000.0, 10.0},
    {"damping", "Damping", "N s/m", 0.0, 1000.0, 2.0},
};

void add(const Plan& plan, const ForceValues& values, double, const double* x, const double* v, double* f) {
  const std::size_t n = plan.points;
  double mass = 0.0;
  for (std::size_t i = 0; i < n; ++i) mass += plan.mass[i];
  if (mass == 0.0) return;
  for (int c = 0; c < plan.dimensions; ++c) {
    double place = 0.0, speed = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      place += plan.mass[i] * x[c * n + i];
      speed += plan.mass[i] * v[c * n + i];
    }
    const double acceleration = -(values[3] * (place / mass - values[c]) + values[4] * speed / mass) / mass;
    for (std::size_t i = 0; i < n; ++i) f[c * n + i] += plan.mass[i] * acceleration;
  }
}

}  // namespace

constinit const ForceTerm mass_center_force{
    .id = "mass_center",
    .label = "Pull of the centre of mass",
    .description = "Draws all points alike so that their centre of mass goes to a place.",
    .numbers = numbers,
    .add = add,
};

}  // namespace hooke
