#include <gtest/gtest.h>

#include "scene/step_advice.h"
#include "sim/methods/integrator.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

System with_plates(std::initializer_list<double> frequencies) {
  System system;
  for (const double frequency : frequencies)
    system.colliders.push_back({.shape = Plane{}, .path = {.amplitude = {0.0, 0.01, 0.0}, .frequency = frequency}});
  return system;
}

Settings settings_with(const char* id, int substeps) { return {.integrator = find_integrator(id), .substeps = substeps}; }

TEST(OscillationWarning, NamesTheFastestColliderThatTheStepsDoNotResolve) {
  const System system = with_plates({1.0, 240.0, 120.0});
  const std::string warning = oscillation_warning(system, settings_with("velocity_verlet", 1)).value_or("");
  EXPECT_EQ(warning, "colliders[1].frequency: 240: is not resolved by 1 substep per frame; 64 are recommended");
  EXPECT_TRUE(oscillation_warning(system, settings_with("velocity_verlet", 63)));
  EXPECT_FALSE(oscillation_warning(system, settings_with("velocity_verlet", 64)));
}

TEST(OscillationWarning, IsNotGivenForMethodsThatResolveItThemselves) {
  for (const char* id : {"auto", "dop853"}) EXPECT_FALSE(oscillation_warning(with_plates({240.0}), settings_with(id, 1))) << id;
  EXPECT_EQ(oscillation_warning(with_plates({1e6}), settings_with("auto", 1)),
            "colliders[0].frequency: 1,000,000: is not resolved by 65,536 substeps per frame, the maximum of auto");
  EXPECT_EQ(oscillation_warning(with_plates({2e7}), settings_with("xpbd", 2)),
            "colliders[0].frequency: 2×10⁷: is not resolved by 2 substeps per frame, nor by 1,000,000");
}

// Also where another limit is exceeded as well, with fewer substeps than the plate needs.
TEST(OscillationWarning, EveryRecommendedNumberResolvesColliders) {
  TestSim sim;
  sim.system.colliders = with_plates({240.0}).colliders;
  sim.join(sim.nail(Vec3(0.0)), sim.add({1.0, 0.0, 0.0}), 4e4, 1.0);
  for (const char* id : {"velocity_verlet", "symplectic_euler", "runge_kutta4", "explicit_euler"}) {
    const std::string warning = step_warning(sim.system, sim.state, settings_with(id, 1)).value_or("");
    EXPECT_NE(warning.find("64 "), std::string::npos) << warning;
    EXPECT_NE(warning.find("recommended"), std::string::npos) << warning;
  }
}

TEST(OscillationWarning, IgnoresCollidersThatDoNotOscillateOrAreDrawnOnly) {
  System system = with_plates({240.0, 240.0, 0.0, 240.0});
  system.colliders[0].path.amplitude = Vec3(0.0);
  system.colliders[1].solid = false;
  system.dimensions = 2;
  system.colliders[3].path.amplitude = {0.0, 0.0, 0.01};
  EXPECT_EQ(oscillation_warning(system, settings_with("velocity_verlet", 1)), std::nullopt);
}

}  // namespace
}  // namespace hooke
