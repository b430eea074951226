// The warning of a run about edges that pass through faces or springs.
#include <gtest/gtest.h>

#include "study/hard_cases/test_network.h"
#include "study/run_monitor.h"

namespace hooke {
namespace {

TEST(RunMonitor, BlamesNoNailsForSpringsThatCrossFromTheStart) {
  TestNetwork network;
  network.system.dimensions = 2;
  network.system.contact.springs = true;
  const PointId a = network.add({0.0, 0.0, 0.0}, 1.0), b = network.add({1.0, 1.0, 0.0}, 1.0);
  const PointId c = network.add({1.0, 0.0, 0.0}, 1.0), d = network.add({0.0, 1.0, 0.0}, 1.0);
  network.join(a, b, 100.0, 1.4);
  for (const bool crosses : {true, false}) {
    if (crosses) network.join(c, d, 100.0, 1.4);
    RunMonitor monitor(make_plan(network.system), {}, network.system, network.state, 0);
    monitor.note_crossings(1, 2.0);
    const std::vector<std::string> warnings = monitor.warnings({});
    EXPECT_EQ(warnings.size(), crosses ? 0u : 1u);
    if (!warnings.empty()) {
      EXPECT_EQ(warnings[0], "up to 1 edge passes through faces or springs, from 2 s on");
    }
    network.system.set_springs(std::vector<Spring>{network.system.springs()[0]});
  }
}

}  // namespace
}  // namespace hooke
