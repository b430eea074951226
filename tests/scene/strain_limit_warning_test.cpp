#include "scene/warnings/warnings.h"

#include <gtest/gtest.h>

#include "support/test_sim.h"

namespace hooke {
namespace {

TEST(StrainLimitWarning, NamesTheFirstSpringThatStartsTooLong) {
  TestSim sim;
  const PointId nail = sim.nail(Vec3(0.0)), near = sim.add({1.04, 0.0, 0.0}), far = sim.add({2.0, 0.0, 0.0});
  sim.join(nail, near, 100.0, 1.0);
  EXPECT_EQ(strain_limit_warning(sim.system, sim.state), std::nullopt);
  sim.system.strain_limit = 0.05;
  EXPECT_EQ(strain_limit_warning(sim.system, sim.state), std::nullopt);
  sim.join(nail, far, 100.0, 0.5);
  EXPECT_EQ(
      strain_limit_warning(sim.system, sim.state),
      "strain_limit_percent: 5 %: spring 1 (points 0 and 2) starts 2 m long, where the limit is 0.525 m: the first substep shortens it at "
      "once");
  sim.system.strain_limit = 0.02;
  EXPECT_EQ(
      strain_limit_warning(sim.system, sim.state),
      "strain_limit_percent: 2 %: spring 0 (points 0 and 1) starts 1.04 m long, where the limit is 1.02 m (the first of 2 such springs): "
      "the first substep shortens it at once");
}

// A limit is not imposed on springs that cannot become shorter, have no rest length, or are as long as the limit leaves them.
TEST(StrainLimitWarning, IsNotGivenForSpringsThatTheLimitLeavesAlone) {
  TestSim sim;
  sim.system.strain_limit = 0.05;
  const PointId nail = sim.nail(Vec3(0.0)), other_nail = sim.nail({2.0, 0.0, 0.0}), point = sim.add({1.055, 0.0, 0.0});
  sim.join(nail, other_nail, 100.0, 1.0);
  sim.join(other_nail, point, 100.0, 0.0);
  sim.join(nail, point, 100.0, 1.0);
  EXPECT_EQ(strain_limit_warning(sim.system, sim.state), std::nullopt);
}

}  // namespace
}  // namespace hooke
