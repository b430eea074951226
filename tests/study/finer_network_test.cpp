// Sheets and ropes with twice the resolution are what their generators make with twice the resolution.
#include "study/check/finer_network.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "formats/scene_file.h"

namespace hooke {
namespace {

constexpr Index max_points = 10'000;

Scene generated(const std::string& generator) { return parse_scene(R"({"hooke": 1, "generators": [)" + generator + "]}", "scene").scene; }

// Rounded to a micrometer.
using Place = std::array<long, 3>;
Place place_of(const Vec3& x) { return {std::lround(1e6 * x.x), std::lround(1e6 * x.y), std::lround(1e6 * x.z)}; }

std::map<Place, Point> points_by_place(const System& system, const State& state) {
  std::map<Place, Point> points;
  for (Index i = 0; i < system.point_count(); ++i) points[place_of(state.position[i])] = system.points()[i];
  return points;
}

std::map<std::pair<Place, Place>, Spring> springs_by_place(const System& system, const State& state) {
  std::map<std::pair<Place, Place>, Spring> springs;
  for (const Spring& spring : system.springs()) {
    Place first = place_of(state.position[system.index_of(spring.first)]),
          second = place_of(state.position[system.index_of(spring.second)]);
    if (second < first) std::swap(first, second);
    springs[{first, second}] = spring;
  }
  return springs;
}

// Each with its corners in ascending order.
std::multiset<std::array<Place, 3>> faces_by_place(const System& system, const State& state) {
  std::multiset<std::array<Place, 3>> faces;
  for (const Face& face : system.faces) {
    std::array<Place, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) corners[c] = place_of(state.position[system.index_of(face.points[c])]);
    std::ranges::sort(corners);
    faces.insert(corners);
  }
  return faces;
}

void expect_same(const FinerNetwork& finer, const Scene& expected) {
  const auto points = points_by_place(finer.system, finer.state), wanted = points_by_place(expected.system, expected.state);
  ASSERT_EQ(points.size(), wanted.size());
  for (const auto& [place, point] : wanted) {
    ASSERT_TRUE(points.contains(place));
    EXPECT_NEAR(points.at(place).mass, point.mass, 1e-12 * point.mass);
    EXPECT_EQ(points.at(place).nailed, point.nailed);
  }
  const auto springs = springs_by_place(finer.system, finer.state), wanted_springs = springs_by_place(expected.system, expected.state);
  ASSERT_EQ(springs.size(), wanted_springs.size());
  ASSERT_EQ(finer.system.springs().size(), expected.system.springs().size());
  for (const auto& [place, spring] : wanted_springs) {
    ASSERT_TRUE(springs.contains(place));
    const Spring& one = springs.at(place);
    EXPECT_EQ(one.family, spring.family);
    EXPECT_NEAR(one.stiffness, spring.stiffness, 1e-9 * spring.stiffness);
    EXPECT_NEAR(one.damping, spring.damping, 1e-9);
    EXPECT_NEAR(one.rest_length, spring.rest_length, 1e-9);
    EXPECT_EQ(one.break_strain, spring.break_strain);
  }
  EXPECT_EQ(faces_by_place(finer.system, finer.state), faces_by_place(expected.system, expected.state));
}

TEST(FinerNetwork, ASheetIsTheOneThatItsGeneratorMakesWithTwiceTheResolution) {
  const auto cloth = [](int columns, int rows) {
    return generated(
        R"({"type": "cloth", "corner": [0, 0, 0], "across": [1.2, 0, 0], "down": [0, -0.7, 0], "points": [)" + std::to_string(columns) +
        ", " + std::to_string(rows) +
        R"(], "density": 0.3, "stiffness": 900, "damping": 0.4, "shear_stiffness": 300, "bend_stiffness": 40, "nail": ["top"]})");
  };
  const Scene coarse = cloth(7, 5);
  const auto finer = refine_network(coarse.system, coarse.state, max_points);
  ASSERT_TRUE(finer);
  EXPECT_EQ(finer->sheets, 1);
  EXPECT_EQ(finer->ropes, 0);
  expect_same(*finer, cloth(13, 9));
}

TEST(FinerNetwork, ARopeIsTheOneThatItsGeneratorMakesWithTwiceTheResolution) {
  const auto rope = [](int points) {
    return generated(R"({"type": "rope", "from": [0, 0, 0], "to": [2, 0, 0], "points": )" + std::to_string(points) +
                     R"(, "mass": 0.5, "stiffness": 70, "damping": 0.2, "mass_model": "tributary", "nail": ["from"]})");
  };
  const Scene coarse = rope(12);
  const auto finer = refine_network(coarse.system, coarse.state, max_points);
  ASSERT_TRUE(finer);
  EXPECT_EQ(finer->ropes, 1);
  expect_same(*finer, rope(23));
}

TEST(FinerNetwork, ALoadOnARopeStaysWhereItIsAndTheTotalMassIsTheSame) {
  Scene scene = generated(R"({"type": "rope", "from": [0, 0, 0], "to": [2, 0, 0], "points": 12, "mass": 1.2, "stiffness": 70})");
  scene.system.point(11).mass += 5.0;
  scene.system.point(4).mass += 2.0;
  const auto finer = refine_network(scene.system, scene.state, max_points);
  ASSERT_TRUE(finer);
  double total = 0.0;
  for (const Point& point : finer->system.points()) total += point.mass;
  EXPECT_NEAR(total, 8.2, 1e-12);
  EXPECT_NEAR(finer->system.points()[22].mass, 5.0 + 0.1 - 0.025, 1e-12);
  EXPECT_NEAR(finer->system.points()[8].mass, 2.0 + 0.05, 1e-12);
  EXPECT_NEAR(finer->system.points()[7].mass, 0.05, 1e-12);
  // ids are those of before
  EXPECT_EQ(finer->system.points()[8].id, scene.system.points()[4].id);
}

TEST(FinerNetwork, AStretchedSheetPullsWithTheSameForce) {
  // stretched uniformly, with border springs as strong as the others: a cord along the border
  Scene scene = generated(
      R"({"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -1, 0], "points": [6, 6], "density": 1, "stiffness": 100, "mass_model": "equal", "stencil": 12})");
  for (Vec3& x : scene.state.position) x.x *= 1.1;
  const auto finer = refine_network(scene.system, scene.state, max_points);
  ASSERT_TRUE(finer);
  // the forces along x across a cut
  const auto force = [](const System& system, const State& state, double cut) {
    double sum = 0.0;
    for (const Spring& spring : system.springs()) {
      const Vec3 a = state.position[system.index_of(spring.first)], b = state.position[system.index_of(spring.second)];
      if ((a.x < cut) == (b.x < cut)) continue;
      const double length = glm::length(b - a);
      sum += spring.stiffness * (length - spring.rest_length) * std::abs(b.x - a.x) / length;
    }
    return sum;
  };
  const double coarse = force(scene.system, scene.state, 0.5);
  // the cut in the middle goes through two bend springs per row in both
  EXPECT_NEAR(force(finer->system, finer->state, 0.5), coarse, 1e-9 * coarse);
}

TEST(FinerNetwork, TrussesLatticesAndFewMassesAreNeitherSheetsNorRopes) {
  for (const char* id : {"bridge", "jelly_cubes", "two_masses", "three_masses", "spring_pendulum"}) {
    const Scene scene = load_scene(find_scene(id)).scene;
    EXPECT_FALSE(refine_network(scene.system, scene.state, max_points)) << id;
  }
  for (const char* id : {"cloth", "rope", "curtain", "flag", "drum_32", "catenary", "trampoline"}) {
    const Scene scene = load_scene(find_scene(id)).scene;
    EXPECT_TRUE(refine_network(scene.system, scene.state, max_points)) << id;
  }
}

}  // namespace
}  // namespace hooke
