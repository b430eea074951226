// The run monitor does not warn about correct runs of bodies filled with gas.
#include <gtest/gtest.h>

#include "sim/step/divergence.h"
#include "study/hard_cases/monitored_run.h"
#include "support/convergence.h"
#include "support/gas_bodies.h"

namespace hooke {
namespace {

class GasMonitor : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, GasMonitor, testing::ValuesIn(every_method()), method_name);

// Squeezed bodies swell, vibrate and shrink again as their gas leaks: their energy grows to a multiple of what it was.
TEST_P(GasMonitor, DoesNotMistakeTheWorkOfTheGasForAnError) {
  for (const bool is_ball : {false, true})
    for (const GasOptions& gas : {GasOptions{.leak = 1.0}, {.pressure = 20.0, .ambient = 1e3, .leak = 0.5, .leak_start = 0.3}}) {
      TestSim sim = is_ball ? gas_ball(0, 60.0, gas) : gas_ring(12, 120.0, gas);
      for (Vec3& x : sim.state.position) x *= 0.9;
      TestNetwork network;
      network.system = sim.system;
      network.state = sim.state;
      initialize_supply(network.system, network.state);
      const Settings settings = settings_for(method(), network.system, {.min = 20, .free = 100, .fraction = 0.1, .max = 3000});
      if (settings.substep() > largest_stable_step(method(), bound_spectrum(network.system))) continue;
      MonitoredRun run(network, settings);
      EXPECT_TRUE(run.run(1.0)) << is_ball;
      EXPECT_LT(run.monitor().energy_rise(), Tolerance{}.energy) << is_ball;
      // at this step, these methods lose a visible part of the energy, and that is what the monitor reports
      if (method().order == 1 && method().energy == EnergyTrend::Falls) continue;
      const std::vector<std::string> warnings = run.monitor().warnings({});
      EXPECT_TRUE(warnings.empty()) << is_ball << ' ' << warnings.front();
    }
}

}  // namespace
}  // namespace hooke
