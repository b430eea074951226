// The search for a cheaper method: what it finds is no less accurate.
#include <gtest/gtest.h>

#include "sim/control/frame_error.h"
#include "study/cheaper_method.h"
#include "support/nets.h"

namespace hooke {
namespace {

TEST(CheaperMethod, IsNoLessAccurateThanThePresentOne) {
  TestSim sim = net(8, 1e4, 0.0);
  sim.run(default_integrator(), 0.2, 2000);
  // far too many steps of a method of low order
  const Settings wasteful{.integrator = find_integrator("implicit_euler"), .substeps = 64};
  const auto cheaper = find_cheaper_method(sim.system, sim.state, wasteful, std::atomic<bool>(false));
  ASSERT_TRUE(cheaper);
  EXPECT_LT(cheaper->cost, 1.0 / worthwhile_saving);
  const Settings proposed{.integrator = cheaper->integrator, .substeps = cheaper->substeps};
  EXPECT_LT(estimate_frame_error(sim.system, proposed, sim.state), 1.5 * estimate_frame_error(sim.system, wasteful, sim.state));
}

TEST(CheaperMethod, ResolvesCollidersThatOscillate) {
  TestSim sim = net(8, 1e2, 0.0);
  sim.system.colliders = {{.shape = Plane{.point = {0.0, -50.0, 0.0}}, .path = {.amplitude = {0.0, 0.01, 0.0}, .frequency = 240.0}}};
  const Settings wasteful{.integrator = find_integrator("implicit_euler"), .substeps = 640};
  const auto cheaper = find_cheaper_method(sim.system, sim.state, wasteful, std::atomic<bool>(false));
  ASSERT_TRUE(cheaper);
  EXPECT_GE(cheaper->substeps, 64);
}

TEST(CheaperMethod, ThereIsNoneWhereTheErrorIsRoundingError) {
  TestSim sim;
  sim.add(Vec3(0.0));
  EXPECT_FALSE(find_cheaper_method(sim.system, sim.state, {}, std::atomic<bool>(false)));
}

}  // namespace
}  // namespace hooke
