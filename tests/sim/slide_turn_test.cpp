// Slides on a plane that forces turn within a step.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <optional>
#include <random>

#include "support/convergence.h"
#include "support/fall.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

class SlideThatTurns : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, SlideThatTurns, testing::ValuesIn(every_method()), method_name);

// Also where forces that are not along the motion reverse it within a step, and with hardly any friction. HOOKE_SEED: other velocities.
TEST_P(SlideThatTurns, WithoutFrictionMovesAsIfThePlaneWereAbsent) {
  const char* seed = std::getenv("HOOKE_SEED");
  std::mt19937 random(seed != nullptr ? static_cast<unsigned>(std::atoi(seed)) : 1u);
  std::uniform_real_distribution<double> speed(-0.04, 0.04);
  constexpr double stiffness = 200.0, mass = 0.5, length = 0.5;
  for (int scene = 0; scene < 10; ++scene) {
    const Vec3 velocity{speed(random), 0.0, speed(random)};
    const auto swinging = [&](std::optional<double> friction, int steps = 480) {
      TestSim sim;
      const PointId point = sim.add({1.2 * length, 0.0, 0.0}, mass, velocity);
      sim.join(point, sim.nail(Vec3(0.0)), stiffness, length);
      if (friction)
        sim.system.colliders = {{.shape = Plane{}, .friction = *friction}};
      else
        sim.system.gravity = Vec3(0.0);
      sim.run(method(), 1.0, steps);
      return sim.state.position[0];
    };
    const double below = g / (480.0 * 480.0);
    double bound = 0.5 * stiffness / mass * below * below / length;
    if (method().amplification({.h_lambda = 0.1}).third != 0.0) bound = glm::distance(swinging({}), swinging({}, 960));
    EXPECT_LT(glm::distance(swinging(0.0), swinging({})), bound) << velocity.x << " " << velocity.z;
    if (method().order == 1) continue;
    const double path_of_step = std::sqrt(stiffness / mass) * 0.2 * length / 480.0;  // under friction, methods are of first order
    EXPECT_LT(glm::distance(swinging(1e-6), swinging(0.0)), path_of_step) << velocity.x << " " << velocity.z;
  }
}

}  // namespace
}  // namespace hooke
