// Every method on bodies filled with gas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/methods/rows.h"
#include "sim/step/divergence.h"
#include "support/convergence.h"
#include "support/gas_bodies.h"

namespace hooke {
namespace {

class PressureMethods : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, PressureMethods, testing::ValuesIn(every_method()), method_name);

TEST_P(PressureMethods, AgreeOnBodiesThatVibrate) {
  for (const bool is_ball : {false, true}) {
    TestSim sim = is_ball ? gas_ball(1, 20.0, {.pressure = 20.0}) : gas_ring(16, 50.0, {.pressure = 20.0});
    for (Vec3& x : sim.state.position) x.y *= 0.9;
    sim.state.velocity[0].x = 0.5;
    TestSim exact = sim;
    exact.run(dop853, 0.2, 1, 1e-10);
    const double step = 0.05 * largest_stable_step(velocity_verlet, bound_spectrum(sim.system));
    const int steps = method().order == 1 ? 2000 : static_cast<int>(std::ceil(0.2 / step));
    sim.run(method(), 0.2, steps, 1e-8);
    double error = 0.0;
    for (std::size_t i = 0; i < sim.state.position.size(); ++i)
      error = std::max(error, glm::distance(sim.state.position[i], exact.state.position[i]));
    EXPECT_LT(error, method().order == 1 ? 5e-3 : 2e-4) << is_ball;
  }
}

TEST_P(PressureMethods, AreStableWithinTheirLimit) {
  for (const bool is_ball : {false, true})
    for (const GasOptions& gas : {GasOptions{.pressure = 50.0}, {.pressure = 5.0, .ambient = 1e4}}) {
      TestSim sim = is_ball ? gas_ball(1, 100.0, gas) : gas_ring(16, 500.0, gas);
      for (Vec3& x : sim.state.position) x.y *= 0.9;
      initialize_supply(sim.system, sim.state);
      const double limit = largest_stable_step(method(), bound_spectrum(sim.system));
      if (limit == 0.0) continue;  // amplifies undamped motion at any step
      const int substeps = std::isfinite(limit) ? static_cast<int>(std::ceil(1.0 / 60.0 / limit)) : 1;
      for (int frame = 0; frame < 30; ++frame) {
        sim.run(method(), 1.0 / 60.0, substeps, 1e-4);
        ASSERT_FALSE(find_divergence(sim.system, sim.state, compute_energy(sim.system, sim.state)))
            << frame << ", " << is_ball << ", " << substeps;
      }
    }
}

// A balloon that falls and spins keeps its momentum with every step.
TEST_P(PressureMethods, ConserveMomentum) {
  TestSim sim = gas_ball(1, 50.0, {});
  for (Vec3& x : sim.state.position) x.y *= 0.9;
  for (Vec3& v : sim.state.velocity) v = {0.5, 0.0, -0.2};
  const Vec3 before = compute_momentum(sim.system, sim.state).linear;
  sim.run(method(), 1.0 / 60.0, 20, 1e-6);
  EXPECT_LT(glm::length(compute_momentum(sim.system, sim.state).linear - before), 1e-9);
}

}  // namespace
}  // namespace hooke
