#include "scene/warnings/warnings.h"

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
                                                            "face of 0.34 m, which passes through it: use a nailed point "
                                                            "of that radius, with contact of faces"});
  EXPECT_TRUE(warnings(0.1, "false").empty());
  EXPECT_TRUE(warnings(0.15, "true").empty());
}

// A peg as wide as the gaps of a rope, of 0.2 m with points of a quarter of it, and the point that the warning names instead.
TEST(SmallColliderWarning, NamesWhatStopsTheRope) {
  const std::string rope = R"({"hooke": 1, "dimensions": 2, "contact": {"springs": true}, "generators": [{"type": "rope",
    "from": [-0.5, 1, 0], "to": [0.5, 1, 0], "points": 6, "mass": 0.2, "stiffness": 100}], )";
  const auto warnings = warnings_of(rope + R"("colliders": [{"type": "sphere", "center": [0, 0.5, 0], "radius": 0.05}]})");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].ends_with("use a nailed point of that radius, with contact of springs")) << warnings[0];
  const Scene scene = parse(rope + R"("points": [{"position": [0, 0.5, 0], "nailed": true, "radius": 0.05}]})");
  TestSim sim;
  sim.system = scene.system;
  sim.state = scene.state;
  sim.run(default_integrator(), 1.0, 1200);
  EXPECT_GT(sim.state.position[3].y, 0.5);
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
