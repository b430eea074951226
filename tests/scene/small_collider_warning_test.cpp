#include "scene/warnings/small_collider_warning.h"

#include <gtest/gtest.h>

#include "support/parse_text.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

// A cloth of cells of 0.24 m with points of a quarter of it.
TEST(SmallColliderWarning, NamesTheBallThatFitsBetweenThePointsOfACloth) {
  const auto warnings = [](double radius, const char* solid) {
    return warnings_of(R"({"hooke": 1, "generators": [{"type": "cloth", "corner": [0, 1, 0], "across": [0.96, 0, 0], "down": [0, 0, 0.96],
      "points": [5, 5], "density": 0.2, "sheet_stiffness": 60}], "colliders": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0]},
      {"type": "sphere", "center": [0.5, 0.5, 0.5], "solid": )" +
                       std::string(solid) + R"(, "radius": )" + std::to_string(radius) + "}]}");
  };
  EXPECT_EQ(warnings(0.1, "true"), std::vector<std::string>{"test.json: colliders[1]: a ball of radius 0.1 m fits between the points of a "
                                                            "face of 0.34 m, which passes through it: only points touch colliders"});
  EXPECT_TRUE(warnings(0.1, "false").empty());
  EXPECT_TRUE(warnings(0.15, "true").empty());
}

// A bar passes, a slab does not; springs between nails do not count.
TEST(SmallColliderWarning, IsOfWhatPassesAndMayMove) {
  TestSim sim;
  const PointId nail = sim.nail(Vec3(0.0)), other = sim.nail({1.0, 0.0, 0.0}), free = sim.add({2.0, 0.0, 0.0});
  sim.join(nail, other, 100.0, 1.0);
  const Collider bar{.shape = Box{Vec3(-0.1, -0.1, -5.0), Vec3(0.1, 0.1, 5.0)}},
      slab{.shape = Box{Vec3(-5.0, -0.1, -5.0), Vec3(5.0, 0.1, 5.0)}};
  EXPECT_EQ(small_collider_text(sim.system, sim.state, bar), std::nullopt);
  sim.join(other, free, 100.0, 1.0);
  EXPECT_EQ(small_collider_text(sim.system, sim.state, bar),
            "a box that is 0.2 m wide fits between the points of a spring of 1 m, which passes through it: only points touch colliders");
  EXPECT_EQ(small_collider_text(sim.system, sim.state, slab), std::nullopt);
  EXPECT_EQ(small_collider_text(sim.system, sim.state, {.shape = Plane{}}), std::nullopt);
  sim.system.dimensions = 2;
  EXPECT_NE(small_collider_text(sim.system, sim.state, bar), std::nullopt);
}

}  // namespace
}  // namespace hooke
