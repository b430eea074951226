// Every method on sheets with bending stiffness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/methods/rows.h"
#include "sim/step/divergence.h"
#include "support/bent_sheet.h"
#include "support/convergence.h"

namespace hooke {
namespace {

class BendingMethods : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, BendingMethods, testing::ValuesIn(every_method()), method_name);

// A strip that springs back from a bend, damped and not.
TEST_P(BendingMethods, AgreeOnAStripThatSpringsBack) {
  for (const double damping_time : {0.0, 0.02}) {
    TestSim sim = clamped_strip(9, 0.02, 50.0);
    sim.system.forces[0].values[1] = damping_time;
    bend(sim, 0.8, 0.0);
    TestSim exact = sim;
    exact.run(dop853, 0.1, 1, 1e-10);
    const double step = 0.2 * largest_stable_step(velocity_verlet, bound_spectrum(sim.system));
    const int steps = method().order == 1 ? 1000 : static_cast<int>(std::ceil(0.1 / step));
    sim.run(method(), 0.1, steps, 1e-8);
    double error = 0.0;
    for (std::size_t i = 0; i < sim.state.position.size(); ++i)
      error = std::max(error, glm::distance(sim.state.position[i], exact.state.position[i]));
    EXPECT_LT(error, method().order == 1 ? 4e-3 : 1e-4) << damping_time;
  }
}

// A sheet that is bent, so stiff that explicit methods need 100 substeps.
TEST_P(BendingMethods, AreStableWithinTheirLimit) {
  for (const double damping_time : {0.0, 0.002}) {
    TestSim sim = flat_sheet({7, 5}, 0.5, 20.0, Diagonals::Alternating, damping_time);
    for (Index row = 0; row < 5; ++row) sim.system.point(row * 7).nailed = true;
    bend(sim, 1.5, 0.3);
    for (Index row = 0; row < 5; ++row) sim.state.position[static_cast<std::size_t>(row) * 7].y += 0.01;
    initialize_supply(sim.system, sim.state);
    const double limit = largest_stable_step(method(), bound_spectrum(sim.system));
    if (limit == 0.0) continue;  // amplifies undamped motion at any step, and the springs are undamped
    const int substeps = std::isfinite(limit) ? static_cast<int>(std::ceil(2.0 / 60.0 / limit)) : 1;
    EXPECT_GT(substeps, method().is_implicit() || method().stability == Stability::Adaptive ? 0 : 10);
    for (int frame = 0; frame < 30; ++frame) {
      sim.run(method(), 1.0 / 60.0, substeps, 1e-4);
      ASSERT_FALSE(find_divergence(sim.system, sim.state, compute_energy(sim.system, sim.state))) << frame << ", " << damping_time;
    }
  }
}

// A dashpot that does nothing does not change the limit, however small its coefficient.
TEST_P(BendingMethods, HaveTheSameLimitWithADashpotThatDoesNothing) {
  const auto limit = [&](double damping_time) {
    return largest_stable_step(method(), bound_spectrum(flat_sheet({7, 5}, 0.5, 20.0, Diagonals::Alternating, damping_time).system));
  };
  const double without = limit(0.0);
  for (const double damping_time : {1e-300, 1e-200, 1e-100, 1e-30}) {
    if (std::isfinite(without))
      EXPECT_NEAR(limit(damping_time), without, 1e-6 * without) << damping_time;
    else
      EXPECT_FALSE(std::isfinite(limit(damping_time))) << damping_time;
  }
}

}  // namespace
}  // namespace hooke
