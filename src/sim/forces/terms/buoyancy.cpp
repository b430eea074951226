// f = -b m g: a constant lift, the fraction b of the weight.
#include "sim/forces/terms/rows.h"
#include "sim/plan.h"

namespace hooke {
namespace {

constexpr ForceParameter numbers[] = {{"lift", "Lift", "of the weight", 0.0, 2.0, 0.5}};

void add(const Plan& plan, const ForceValues& values, double, const double*, const double*, double* f) {
  for (int c = 0; c < plan.dimensions; ++c) {
    const double lift = -values[0] * plan.gravity[c];
    double* component = f + static_cast<std::size_t>(c) * plan.points;
    for (Index i = 0; i < plan.points; ++i) component[i] += plan.mass[i] * lift;
  }
}

}  // namespace

constinit const ForceTerm buoyancy_force{
    .id = "buoyancy",
    .label = "Buoyancy",
    .description = "A constant lift, as a fraction of the weight.",
    .numbers = numbers,
    .add = add,
};

}  // namespace hooke
