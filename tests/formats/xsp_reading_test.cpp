// What files of XSpringies say without the walls, as the original reads it (1.12). In these files lengths are in pixels; one pixel is a
// centimeter.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "formats/scene_file.h"
#include "formats/xsp/xsp_file.h"
#include "sim/forces/energy/energy.h"
#include "sim/step/step.h"
#include "sim/step/supply.h"

namespace hooke {
namespace {

constexpr double pixel = 0.01;  // [m]

LoadedScene load_model(const std::string& lines) { return parse_xsp("#1.0\n" + lines, "test.xsp"); }

// Runs the scene with its own settings.
void run(Scene& scene, double seconds) {
  Plan plan = make_plan(scene.system);
  Frame frame;
  for (long i = std::lround(seconds * scene.settings.frame_rate); i > 0; --i) {
    frame.begin(plan, scene.system, scene.settings, scene.state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, scene.state);
  }
}

bool warns(const LoadedScene& loaded, const std::string& words) {
  for (const std::string& warning : loaded.warnings)
    if (warning.find(words) != std::string::npos) return true;
  return false;
}

TEST(Xsp, LinesThatXSpringiesSkipsGiveWarningsAndAreKept) {
  const std::string two = "mass 1 0 0 0 0 1 1\nmass 2 5 0 0 0 1 1\n";
  const LoadedScene loaded = load_model(two + "blob  1 \"x\"\nspng 1 1 3 1 0 5\nspng 2 1 2 1 0 5\nspng 4 3 4 1 0 5\nwind 3\n");
  EXPECT_EQ(loaded.warnings,
            (std::vector<std::string>{"test.xsp: line 4: blob: is not a command, kept", "test.xsp: 1 more line is not a command, kept",
                                      "test.xsp: line 5: spng: 1: mass 3: is not in the file: ignored",
                                      "test.xsp: 1 more spring lacks a mass: ignored"}));
  EXPECT_EQ(loaded.scene.system.spring_count(), 1);
  std::vector<std::string> losses;
  const std::string text = format_xsp(loaded.scene, "again.xsp", losses);
  EXPECT_NE(text.find("\nblob  1 \"x\"\nwind 3\n"), std::string::npos) << text;
  const Scene in_json = parse_scene(format_scene(loaded.scene), "scene.json").scene;
  EXPECT_EQ(format_xsp(in_json, "again.xsp", losses), text);
}

TEST(Xsp, AMassOfZeroIsOne) {
  const LoadedScene loaded = load_model("mass 1 0 0 0 0 0 1\n");
  EXPECT_EQ(loaded.scene.system.points()[0].mass, 1.0);
  EXPECT_TRUE(warns(loaded, "1 mass of 0: 1, as in XSpringies"));
}

TEST(Xsp, AMassHasTheRadiusOfXSpringies) {
  // the integer part of 2 ln(4 m + 1) pixels, at least 1
  const System system = load_model("mass 1 0 0 0 0 1 1\nmass 2 0 0 0 0 40 1\nmass 3 0 0 0 0 0.1 1\nmass 4 0 0 0 0 -40 1\n").scene.system;
  const double radii[] = {3.0, 10.0, 1.0, 4.0};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(system.points()[i].radius, radii[i] * pixel, 1e-15);
}

TEST(Xsp, AMassAtTheCenterRests) {
  Scene scene = load_model("frce 2 1 100 0\nmass 1 321 275 0 0 1 1\n").scene;
  run(scene, 2.0);
  EXPECT_EQ(scene.state.position[0], pixel * Vec3(321, 275, 0));
}

// The values are those of the original with steps of 0.05 ms, in its window.
TEST(Xsp, AMassMovesThroughTheCenterAsInXSpringies) {
  Scene scene = load_model("frce 2 1 1000 1\nmass 1 330 240 0 0 40 1\n").scene;
  run(scene, 5.0);
  EXPECT_NEAR(scene.state.position[0].x / pixel, 327.403329, 0.05);
  EXPECT_NEAR(scene.state.position[0].y / pixel, 250.098166, 0.05);
}

// The values are those of the original with steps of 0.05 ms. What the moving center supplies balances the energy.
TEST(Xsp, AFreeMassAtTheCenterTakesItAlong) {
  const LoadedScene loaded = load_model(
      "cent 1\nfrce 1 1 10 2\nfrce 2 1 100 0\nmass 1 200 200 10 0 2 1\nmass 2 300 250 0 0 2 1\n"
      "mass 3 280 150 0 5 2 1\nspng 1 1 2 2 0 90\n");
  std::vector<std::string> losses;
  for (Scene scene : {loaded.scene, parse_scene(format_scene(loaded.scene), "again.json").scene,
                      parse_xsp(format_xsp(loaded.scene, "again.xsp", losses), "again.xsp").scene}) {
    initialize_supply(scene.system, scene.state);
    run(scene, 5.0);
    const Vec3 expected[] = {Vec3(381.576092, 192.403365, 0.0), Vec3(379.78589, 242.935242, 0.0), Vec3(324.750358, 169.432551, 0.0)};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(glm::distance(scene.state.position[i] / pixel, expected[i]), 0.01) << i;
    EXPECT_NEAR(compute_energy(scene.system, scene.state).total(), scene.state.supply.net_input, 1e-4 * scene.state.supply.scale);
  }
  EXPECT_TRUE(losses.empty());
}

TEST(Xsp, TheVelocityOfANailOnADashpotGivesAWarning) {
  const std::string masses = "mass 1 100 100 5 0 -1 1\nmass 2 150 100 0 0 1 1\n";
  EXPECT_TRUE(warns(load_model(masses + "spng 1 1 2 10 1 50\n"), "1 spring is damped towards a nail at rest"));
  EXPECT_TRUE(load_model(masses + "spng 1 1 2 10 0 50\n").warnings.empty());
}

TEST(Xsp, AFallTowardsTheCenterFollowsTheClosedForm) {
  // a = p1 / d: v^2 / 2 = p1 ln(d0 / d); the radius of a mass of 40 is 10 pixels
  LoadedScene loaded = load_model("frce 2 1 1000 1\nmass 40 330 240 0 0 40 1\n");
  EXPECT_FALSE(warns(loaded, "approximate"));
  Scene& scene = loaded.scene;
  EXPECT_NEAR(scene.system.forces[0].values[5], 11 * pixel, 1e-15);
  run(scene, 0.75);
  const double d0 = std::hypot(9.0, 35.0), d = glm::distance(scene.state.position[0], pixel * Vec3(321, 275, 0)) / pixel;
  ASSERT_GT(d, 11.0);
  ASSERT_LT(d, 0.9 * d0);
  EXPECT_NEAR(0.5 * std::pow(glm::length(scene.state.velocity[0]) / pixel, 2) / (1000.0 * std::log(d0 / d)), 1.0, 1e-3);
}

// The values are those of the original's law, p1 / d from each wall less the radius of 10 pixels, by Runge-Kutta 4 with steps of 0.5 ms.
TEST(Xsp, WallsRepelTheSurfaceOfAMass) {
  Scene scene = load_model("frce 3 1 10000 1\nwall 1 1 1 1\nmass 1 100 240 -30 0 40 1\n").scene;
  run(scene, 5.0);
  EXPECT_NEAR(scene.state.position[0].x, 5.288818845, 1e-6);
  EXPECT_NEAR(scene.state.position[0].y, 3.064161337, 1e-6);
}

// Both fall 97 pixels to the wall; the radius of a mass of 1 is 3 pixels.
TEST(Xsp, AMassOutsideMovesNoWallAndIsFree) {
  LoadedScene loaded = load_model("frce 0 1 10 0\nwall 0 0 0 1\nmass 1 100 100 0 0 1 1\nmass 2 300 -9000 0 0 1 1\n");
  EXPECT_TRUE(warns(loaded, "y = 0 and 550 pixels"));
  run(loaded.scene, 6.0);
  const double fall = std::sqrt(2.0 * 97.0 / 10.0), rise = 6.0 - fall;
  EXPECT_NEAR(loaded.scene.state.position[0].y / pixel, 3.0 + 10.0 * fall * rise - 5.0 * rise * rise, 1e-6);
  EXPECT_NEAR(loaded.scene.state.position[1].y / pixel, -9000.0 - 5.0 * 36.0, 1e-6);
}

TEST(Xsp, AStickyWallHoldsWhatWouldReboundSlowly) {
  Scene scene = load_model("frce 0 1 10 0\nstck 100\nwall 1 1 1 1\nmass 1 320 100 7 0 1 1\n").scene;
  run(scene, 4.5);
  const Vec3 there = scene.state.position[0];
  EXPECT_NEAR(there.y, 3.0 * pixel, 1e-12);
  EXPECT_NEAR(there.x, (320.0 + 7.0 * std::sqrt(2.0 * 97.0 / 10.0)) * pixel, 1e-9);
  run(scene, 1.5);
  EXPECT_EQ(scene.state.position[0], there);
  EXPECT_EQ(scene.state.velocity[0], Vec3(0.0));
}

// A ball of elasticity 0.5 on a nail of elasticity 1, radii of 3 and 4 pixels, falls 40 pixels and rebounds with 0.75 of its speed.
TEST(Xsp, NailsShareTheirElasticity) {
  Scene scene = load_model("frce 0 1 10 0\nfrce 4 1 0 0\nmass 1 100 147 0 0 1 0.5\nmass 2 100 100 0 0 -1 1\n").scene;
  const double fall = std::sqrt(2.0 * 40.0 / 10.0), rise = 1.0;
  run(scene, fall + rise);
  const double time = std::round((fall + rise) * 60.0) / 60.0 - fall;
  EXPECT_NEAR(scene.state.position[0].y / pixel, 107.0 + 0.75 * 10.0 * fall * time - 5.0 * time * time, 1e-6);
}

// The values are those of the original with steps of 0.1 ms. The weight is more than the stickiness.
TEST(Xsp, MassesOnAStickyWallStayOnIt) {
  Scene scene =
      load_model("frce 0 1 10 0\nstck 5\nwall 0 0 0 1\nmass 1 100 50 20 0 1 0\nmass 2 110 53 20 0 1 0\nspng 1 1 2 50 2 14\n").scene;
  run(scene, 6.0);
  EXPECT_LT(glm::distance(scene.state.position[0] / pixel, Vec3(159.2916, 3.0, 0.0)), 0.1);
  EXPECT_LT(glm::distance(scene.state.position[1] / pixel, Vec3(174.8290, 3.0, 0.0)), 0.1);
}

// The stickiness is taken off the rebound: 44.05 pixels/s less 10.
TEST(Xsp, StickinessSlowsTheRebound) {
  Scene scene = load_model("frce 0 1 10 0\nstck 10\nwall 0 0 0 1\nmass 1 320 100 7 0 1 1\n").scene;
  run(scene, 6.0);
  const double fall = std::sqrt(2.0 * 97.0 / 10.0), rise = 6.0 - fall;
  EXPECT_NEAR(scene.state.position[0].y / pixel, 3.0 + (10.0 * fall - 10.0) * rise - 5.0 * rise * rise, 1e-6);
  EXPECT_NEAR(scene.state.velocity[0].x / pixel, 7.0, 1e-9);
}

TEST(Xsp, AWallMultipliesTheTangentialVelocityByTheElasticityToo) {
  Scene scene = load_model("wall 0 0 0 1\nmass 1 100 103 30 -50 1 0.5\n").scene;
  run(scene, 4.0);
  // two seconds before the impact and two after it
  EXPECT_NEAR(scene.state.position[0].x / pixel, 100.0 + 60.0 + 30.0, 1e-9);
  EXPECT_NEAR(scene.state.position[0].y / pixel, 3.0 + 50.0, 1e-9);
}

}  // namespace
}  // namespace hooke
