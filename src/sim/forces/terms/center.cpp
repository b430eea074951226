// a = s / r^p towards a place, r the distance from it, not below r0: p = 2 is gravity's law, p = -1 a spring's.
#include <algorithm>
#include <cmath>

#include "sim/forces/terms/rows.h"
#include "sim/plan.h"

namespace hooke {
namespace {

constexpr ForceParameter numbers[] = {
    {"x", "Centre x", "m", -100.0, 100.0, 0.0},        {"y", "Centre y", "m", -100.0, 100.0, 0.0},
    {"z", "Centre z", "m", -100.0, 100.0, 0.0},        {"strength", "Strength at 1 m", "m/s^2", -1000.0, 1000.0, 1.0},
    {"power", "Falls with power", "", -3.0, 4.0, 2.0}, {"core", "Core radius", "m", 1e-6, 10.0, 0.01},
};

void add(const Plan& plan, const ForceValues& values, double, const double* x, const double*, double* f) {
  const std::size_t n = plan.points;
  for (std::size_t i = 0; i < n; ++i) {
    double towards[3] = {}, squared = 0.0;
    for (int c = 0; c < plan.dimensions; ++c) {
      towards[c] = values[c] - x[c * n + i];
      squared += towards[c] * towards[c];
    }
    if (squared == 0.0) continue;
    const double distance = std::sqrt(squared);
    const double force = plan.mass[i] * values[3] / (std::pow(std::max(distance, values[5]), values[4]) * distance);
    for (int c = 0; c < plan.dimensions; ++c) f[c * n + i] += force * towards[c];
  }
}

}  // namespace

constinit const ForceTerm center_force{
    .id = "center",
    .label = "Pull to a centre",
    .description = "Draws every point to a place, with an acceleration that falls with a power of the distance.",
    .numbers = numbers,
    .add = add,
};

}  // namespace hooke
