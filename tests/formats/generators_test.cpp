// Cloths and ropes of a scene file.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>

#include "formats/scene_file.h"
#include "sim/methods/integrator.h"
#include "support/parse_text.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

std::string generated(const std::string& generator) { return R"({"hooke": 1, "generators": [)" + generator + "]}"; }

TEST(Generators, AClothAsAPlainGraphHasEqualMassesAndTheGivenStiffness) {
  const Scene scene = parse(generated(R"({"type": "cloth", "corner": [0, 0, 0], "across": [2, 0, 0], "down": [0, -1, 0], "points": [3, 2],
      "mass_model": "equal", "density": 0.3, "stiffness": 1000, "damping": 2, "nail": ["top_left", 4]})"));
  ASSERT_EQ(scene.system.point_count(), 6);
  ASSERT_EQ(scene.system.spring_count(), 4 + 3 + 4);
  ASSERT_EQ(scene.system.faces.size(), 4u);
  for (const Point& point : scene.system.points()) EXPECT_DOUBLE_EQ(point.mass, 0.3 * 2.0 / 6.0);
  EXPECT_EQ(scene.state.position[4], Vec3(1.0, -1.0, 0.0));
  for (Index i = 0; i < 6; ++i) EXPECT_EQ(scene.system.points()[i].nailed, i == 0 || i == 4);
  for (const Spring& spring : scene.system.springs()) {
    const bool diagonal = spring.rest_length == std::sqrt(2.0);
    EXPECT_EQ(spring.stiffness, diagonal ? 500.0 : 1000.0);
    EXPECT_EQ(spring.damping, 2.0);
  }
}

TEST(Generators, AClothAsAMaterialHasHalfValuesOnTheBorderAndTheTotalMass) {
  const Scene scene = parse(generated(R"({"type": "cloth", "corner": [0, 0, 0], "across": [3, 0, 0], "down": [0, -3, 0], "points": [4, 4],
      "density": 0.5, "stiffness": 100, "damping": 4})"));
  double total = 0.0;
  for (const Point& point : scene.system.points()) total += point.mass;
  EXPECT_NEAR(total, 0.5 * 9.0, 1e-14);
  EXPECT_DOUBLE_EQ(scene.system.points()[0].mass, 0.125);
  EXPECT_DOUBLE_EQ(scene.system.points()[1].mass, 0.25);
  EXPECT_DOUBLE_EQ(scene.system.points()[5].mass, 0.5);
  for (const Spring& spring : scene.system.springs()) {
    const Vec3 first = scene.state.position[scene.system.index_of(spring.first)],
               second = scene.state.position[scene.system.index_of(spring.second)];
    const bool diagonal = spring.rest_length > 1.2;
    const bool border =
        (first.x == second.x && (first.x == 0.0 || first.x == 3.0)) || (first.y == second.y && (first.y == 0.0 || first.y == -3.0));
    EXPECT_DOUBLE_EQ(spring.stiffness, diagonal || border ? 50.0 : 100.0);
    EXPECT_DOUBLE_EQ(spring.damping, diagonal || border ? 2.0 : 4.0);
  }
}

// The energy of a small uniform strain per area must not depend on the number of points: E = 1/2 sum k (dl)^2.
TEST(Generators, AMaterialClothStoresTheSameEnergyAtEveryResolution) {
  const auto energy_of = [](int columns, int rows, const glm::dmat2& strain) {
    const Scene scene = parse(
        generated(R"({"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -0.6, 0], "stiffness": 80, "points": [)" +
                  std::to_string(columns) + ", " + std::to_string(rows) + "]}"));
    double energy = 0.0;
    for (const Spring& spring : scene.system.springs()) {
      const glm::dvec2 along(scene.state.position[scene.system.index_of(spring.second)] -
                             scene.state.position[scene.system.index_of(spring.first)]);
      const double longer = glm::dot(along, strain * along) / spring.rest_length;
      energy += 0.5 * spring.stiffness * longer * longer;
    }
    return energy;
  };
  for (const glm::dmat2& strain : {glm::dmat2(1, 0, 0, 0), glm::dmat2(0, 0, 0, 1), glm::dmat2(0, 1, 1, 0)}) {
    const double coarse = energy_of(6, 4, strain);
    EXPECT_NEAR(energy_of(11, 7, strain), coarse, 1e-12 * coarse);
    EXPECT_NEAR(energy_of(51, 31, strain), coarse, 1e-12 * coarse);
  }
}

// Without diagonals each column hangs independently. Its springs, n = N - 1 down, carry (n - r - 1/2) / n^2 of the mass M of the sheet, r =
// 0 .. n - 1; the two border columns carry half as much and are half as stiff. In total the lowest row sags by M g / (2 k).
TEST(Generators, AMaterialClothSagsByHalfItsWeightOverItsStiffnessAtEveryResolution) {
  for (const int n : {2, 5, 17}) {
    const Scene scene = parse(generated(R"({"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -1, 0], "density": 1.3,
        "stiffness": 200, "shear_stiffness": 0, "nail": ["top"], "points": [)" +
                                        std::to_string(n) + ", " + std::to_string(n) + "]}"));
    TestSim sim{scene.system, scene.state};
    sim.system.drag = 5.0;
    sim.run(*find_integrator("baraff_witkin"), 20.0, 400);
    for (int column = 0; column < n; ++column) {
      const Vec3 lowest(column / (n - 1.0), -1.0 - 1.3 * 9.81 / (2.0 * 200.0), 0.0);
      EXPECT_LT(glm::distance(sim.state.position[(n - 1) * n + column], lowest), 1e-11) << "N = " << n;
    }
  }
}

TEST(Generators, RopesTakeMassAndStiffnessPerPartOrOfTheWhole) {
  const std::string rope =
      R"({"type": "rope", "from": [0, 0, 0], "to": [2, 0, 0], "points": 5, "mass": 1, "stiffness": 10, "damping": 3, "nail": ["from", "to"])";
  const Scene graph = parse(generated(rope + "}")), whole = parse(generated(rope + R"(, "mass_model": "tributary"})"));
  for (Index i = 0; i < 5; ++i) {
    EXPECT_DOUBLE_EQ(graph.system.points()[i].mass, 0.2);
    EXPECT_DOUBLE_EQ(whole.system.points()[i].mass, i == 0 || i == 4 ? 0.125 : 0.25);
    EXPECT_EQ(graph.system.points()[i].nailed, i == 0 || i == 4);
  }
  for (Index s = 0; s < 4; ++s) {
    EXPECT_EQ(graph.system.springs()[s].stiffness, 10.0);
    EXPECT_EQ(graph.system.springs()[s].damping, 3.0);
    // four springs in series are as stiff as the whole
    EXPECT_EQ(whole.system.springs()[s].stiffness, 40.0);
    EXPECT_EQ(whole.system.springs()[s].damping, 12.0);
  }
}

TEST(Generators, StiffnessPerStrainIsDividedByEachRestLength) {
  const Scene scene = parse(generated(
      R"({"type": "cloth", "corner": [0, 0, 0], "across": [3, 0, 0], "down": [0, -4, 0], "points": [2, 2], "stiffness_per_strain": 60})"));
  ASSERT_EQ(scene.system.spring_count(), 6);
  for (const Spring& spring : scene.system.springs()) EXPECT_DOUBLE_EQ(spring.stiffness, 60.0 / spring.rest_length);
}

TEST(Generators, EveryWordForNailsNailsTheCorrectPoints) {
  const auto nails_of = [](const std::string& word) {
    const Scene scene = parse(generated(
        R"({"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -1, 0], "points": [3, 3], "stiffness": 1, "nail": [")" +
        word + "\"]}"));
    std::string nails;
    for (const Point& point : scene.system.points()) nails += point.nailed ? 'x' : '.';
    return nails;
  };
  EXPECT_EQ(nails_of("top"), "xxx......");
  EXPECT_EQ(nails_of("bottom"), "......xxx");
  EXPECT_EQ(nails_of("left"), "x..x..x..");
  EXPECT_EQ(nails_of("right"), "..x..x..x");
  EXPECT_EQ(nails_of("border"), "xxxx.xxxx");
  EXPECT_EQ(nails_of("corners"), "x.x...x.x");
  EXPECT_EQ(nails_of("top_left"), "x........");
  EXPECT_EQ(nails_of("top_right"), "..x......");
  EXPECT_EQ(nails_of("bottom_left"), "......x..");
  EXPECT_EQ(nails_of("bottom_right"), "........x");
}

TEST(Generators, ArePreservedWhenSavedUnedited) {
  const std::string list = R"([{"type": "rope",   "from": [0, 0, 0], "to": [1, 0, 0], "points": 5, "stiffness": 1}])";
  Scene scene = parse(R"({"hooke": 1, "points": [{"position": [0, 1, 0]}], "generators": )" + list + "}");
  EXPECT_NE(format_scene(scene).find("\"generators\": " + list), std::string::npos);

  // a listed point does not belong to them
  scene.state.position[0] = Vec3(5.0);
  EXPECT_NE(format_scene(scene).find("\"generators\": " + list), std::string::npos);
}

TEST(Generators, AreReplacedByPointsAndSpringsOnceAnyOfThoseIsEdited) {
  const Scene scene = parse(
      generated(R"({"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -1, 0], "points": [3, 3], "stiffness": 1})"));
  const auto expect_listed = [](const Scene& edited) {
    const std::string text = format_scene(edited);
    EXPECT_EQ(text.find("generators"), std::string::npos);
    const Scene again = parse(text);
    EXPECT_EQ(again.system, edited.system);
    EXPECT_EQ(again.state.position, edited.state.position);
    EXPECT_EQ(again.state.velocity, edited.state.velocity);
  };
  Scene edited = scene;
  edited.state.position[4].x = std::nextafter(edited.state.position[4].x, 1.0);
  expect_listed(edited);
  edited = scene;
  edited.state.velocity[4].y = -0.0;
  expect_listed(edited);
  edited = scene;
  edited.system.point(0).nailed = true;
  expect_listed(edited);
  edited = scene;
  edited.system.spring(3)->stiffness = 2.0;
  expect_listed(edited);
  edited = scene;
  edited.system.faces.pop_back();
  expect_listed(edited);
  edited = scene;
  edited.system.append_point({.id = edited.system.new_point_id()});
  edited.state.position.emplace_back(0.0);
  edited.state.velocity.emplace_back(0.0);
  expect_listed(edited);
}

}  // namespace
}  // namespace hooke
