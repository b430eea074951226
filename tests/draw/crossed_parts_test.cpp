// Edges that pass through faces, springs of flat scenes that cross and points that overlap are found, and highlighted in pictures.
#include "scene/crossed_parts.h"

#include <gtest/gtest.h>

#include "support/crossings.h"
#include "support/picture.h"

namespace hooke {
namespace {

// A triangle in the plane z = 0, and another one through it.
TestSim pierced_triangle(double shift) {
  TestSim sim;
  const std::array<Vec3, 6> places{Vec3(-1.0, -1.0, 0.0), {1.0, -1.0, 0.0},         {0.0, 1.0, 0.0},
                                   Vec3(-0.2, 0.0, -0.5), {0.2 + shift, 0.0, -0.5}, {shift, 0.1, 0.5}};
  std::vector<PointId> ids;
  for (const Vec3& place : places) {
    ids.push_back(sim.add(place));
    sim.system.point(sim.system.index_of(ids.back())).radius = 0.01;
  }
  for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}})
    sim.join(ids[static_cast<std::size_t>(i)], ids[static_cast<std::size_t>(j)], 100.0,
             glm::distance(places[static_cast<std::size_t>(i)], places[static_cast<std::size_t>(j)]));
  sim.system.faces = std::vector<Face>{{{ids[0], ids[1], ids[2]}}, {{ids[3], ids[4], ids[5]}}};
  sim.system.contact.faces = true;
  return sim;
}

TEST(CrossedParts, AreThoseThatAnIndependentTestCounts) {
  for (const double shift : {0.0, 0.4, 5.0}) {
    TestSim sim = pierced_triangle(shift);
    if (shift == 5.0)
      for (std::size_t i = 3; i < 6; ++i) sim.state.position[i].x += 5.0;
    const CrossedParts crossed = find_crossed_parts(sim.system, sim.state);
    EXPECT_EQ(static_cast<long>(crossed.edges.size()), CrossingCounter(sim.system).count(sim.state.position)) << shift;
    EXPECT_EQ(crossed.faces.size(), crossed.edges.size());
    EXPECT_EQ(crossed.edges.empty(), shift == 5.0);
  }
}

TEST(CrossedParts, AreNotSoughtWhereFacesDoNotTouch) {
  TestSim sim = pierced_triangle(0.0);
  sim.system.contact.faces = false;
  EXPECT_TRUE(find_crossed_parts(sim.system, sim.state).edges.empty());
}

// Two springs across each other, one beside them, one that is joined to the first, and one on top of it.
TestSim crossed_springs(double height) {
  TestSim sim;
  sim.system.dimensions = 2;
  const auto add = [&](double x, double y) {
    const PointId id = sim.add({x, y, 0.0});
    sim.system.point(sim.system.index_of(id)).radius = 0.01;
    return id;
  };
  const PointId a = add(-1.0, 0.0), b = add(1.0, 0.0), c = add(0.1, height - 1.0), d = add(0.0, height + 1.0);
  sim.join(a, b, 100.0, 2.0);
  sim.join(c, d, 100.0, 2.0);
  sim.join(add(1.5, -1.0), add(1.5, 1.0), 100.0, 2.0);
  sim.join(b, add(-0.5, 0.3), 100.0, 1.5);
  sim.join(add(-0.9, 0.0), add(-0.4, 0.0), 100.0, 0.5);
  sim.system.contact = {.springs = true, .thickness = 0.05};
  return sim;
}

TEST(CrossedParts, AreSpringsOfFlatScenes) {
  const TestSim sim = crossed_springs(0.0);
  const CrossedParts crossed = find_crossed_parts(sim.system, sim.state);
  ASSERT_EQ(crossed.springs.size(), 2u);
  EXPECT_EQ(crossed.across.size(), 2u);
  EXPECT_TRUE(crossed.edges.empty());
  EXPECT_EQ(describe(crossed, sim.system).at(0).count, "2 pairs of springs cross");
  EXPECT_EQ(count_crossings(sim.system, sim.state), 2u);
  const TestSim apart = crossed_springs(5.0);
  EXPECT_TRUE(find_crossed_parts(apart.system, apart.state).empty());
}

TEST(CrossedParts, AreCountedWhetherTheyTouchOrNot) {
  TestSim flat = crossed_springs(0.0), sim = pierced_triangle(0.0);
  flat.system.contact.springs = sim.system.contact.faces = false;
  EXPECT_TRUE(find_crossed_parts(flat.system, flat.state).empty());
  EXPECT_EQ(count_crossings(flat.system, flat.state), 2u);
  EXPECT_EQ(static_cast<long>(count_crossings(sim.system, sim.state)), CrossingCounter(sim.system).count(sim.state.position));
}

// Two balls that overlap, and one beside them.
TestSim overlapping_balls() {
  TestSim sim;
  for (const double x : {0.0, 0.25, 1.0}) sim.system.point(sim.system.index_of(sim.add({x, 0.0, 0.0}))).radius = 0.2;
  sim.system.contact.points = true;
  return sim;
}

TEST(CrossedParts, ArePointsThatOverlap) {
  TestSim sim = overlapping_balls();
  const CrossedParts crossed = find_crossed_parts(sim.system, sim.state);
  ASSERT_EQ(crossed.points.size(), 1u);
  EXPECT_EQ(crossed.deepest, crossed.points[0]);
  EXPECT_NEAR(crossed.depth, 0.15, 1e-12);
  sim.state.position[1].x = 0.5;
  EXPECT_TRUE(find_crossed_parts(sim.system, sim.state).empty());
}

// In their own color, which nothing else in the picture has.
TEST(CrossedParts, AreHighlighted) {
  for (const TestSim& sim : {pierced_triangle(0.0), crossed_springs(0.0), overlapping_balls()}) {
    Camera camera = make_camera({}, sim.system, sim.state, 1.0);
    const auto highlighted = [&](const Marks& marks) {
      const Image image = draw(sim, marks, camera, {.grid = false}, 320, 320);
      int count = 0;
      for (int y = 0; y < 320; ++y)
        for (int x = 0; x < 320; ++x) {
          const Color color = at(image, x, y);
          count += color.green > 150 && color.red < color.green - 70 && color.blue > 110;
        }
      return count;
    };
    EXPECT_EQ(highlighted({}), 0);
    EXPECT_GT(highlighted({.crossed = std::make_shared<const CrossedParts>(find_crossed_parts(sim.system, sim.state))}), 100);
  }
}

}  // namespace
}  // namespace hooke
