// Closed surfaces and lines, their volumes and what is not closed.
#include "sim/plan/enclosures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "support/gas_bodies.h"

namespace hooke {
namespace {

TEST(Enclosures, TheVolumeIsThatOfThePolyhedronWhateverTheOrientationOfItsFacesAndItsPlace) {
  for (const Vec3& place : {Vec3(0.0), Vec3(100.0, -70.0, 50.0)}) {
    TestSim ball = gas_ball(0, 1.0, {}), ring = gas_ring(7, 1.0, {});
    for (TestSim* sim : {&ball, &ring})
      for (Vec3& x : sim->state.position) x += sim->system.dimensions == 2 ? Vec3(place.x, place.y, 0.0) : place;
    const double edge = ball.system.springs()[0].rest_length;
    EXPECT_NEAR(PackedGas(ball).volume(), 5.0 / 12.0 * (3.0 + std::sqrt(5.0)) * edge * edge * edge, 1e-13);
    EXPECT_NEAR(PackedGas(ring).volume(), 3.5 * std::sin(2.0 * gas_pi / 7.0), 1e-13);
  }
}

TEST(Enclosures, TheFullVolumeIsThatOfTheBallOrCircleWithTheSameSurface) {
  const TestSim ball = gas_ball(2, 1.0, {}), ring = gas_ring(9, 1.0, {});
  double surface = 0.0, length = 0.0;
  for (const Face& face : ball.system.faces)
    surface += 0.5 * glm::length(glm::cross(ball.position(face.points[1]) - ball.position(face.points[0]),
                                            ball.position(face.points[2]) - ball.position(face.points[0])));
  for (const Spring& spring : ring.system.springs()) length += spring.rest_length;
  const double radius = std::sqrt(surface / (4.0 * gas_pi));
  EXPECT_NEAR(plan_enclosures(ball.system).enclosures.at(0).full_volume, 4.0 / 3.0 * gas_pi * radius * radius * radius, 1e-12);
  EXPECT_NEAR(plan_enclosures(ring.system).enclosures.at(0).full_volume, length * length / (4.0 * gas_pi), 1e-12);
  // the polyhedron itself has less, by this part
  EXPECT_NEAR(PackedGas(ball).volume() / plan_enclosures(ball.system).enclosures[0].full_volume, 0.994, 0.001);
}

TEST(Enclosures, AnOpenSurfaceIsNone) {
  TestSim ball = gas_ball(1, 1.0, {});
  EXPECT_EQ(plan_enclosures(ball.system).open, 0);
  ball.system.faces.pop_back();
  EXPECT_TRUE(plan_enclosures(ball.system).empty());
  EXPECT_EQ(plan_enclosures(ball.system).open, 1);

  // an edge of three faces
  ball = gas_ball(1, 1.0, {});
  const PointId tip = ball.add({0.0, 0.0, 3.0});
  const Face& face = ball.system.faces[0];
  ball.system.faces.push_back({{face.points[0], face.points[1], tip}});
  EXPECT_TRUE(plan_enclosures(ball.system).empty());

  // faces without springs
  ball = gas_ball(1, 1.0, {});
  ball.system.set_springs({});
  EXPECT_TRUE(plan_enclosures(ball.system).empty());
  EXPECT_EQ(plan_enclosures(ball.system).open, 1);
}

TEST(Enclosures, SurfacesThatShareNoEdgeAreSeparate) {
  TestSim two = gas_ball(0, 1.0, {}), other = gas_ball(0, 1.0, {});
  std::vector<PointId> ids;
  for (const Vec3& x : other.state.position) ids.push_back(two.add(0.5 * x + Vec3(3.0, 0.0, 0.0), 1.0));
  for (const Spring& spring : other.system.springs())
    two.join(ids[other.system.index_of(spring.first)], ids[other.system.index_of(spring.second)], 1.0, 0.5 * spring.rest_length);
  for (const Face& face : other.system.faces) {
    Face copy;
    for (int c = 0; c < 3; ++c) copy.points[c] = ids[other.system.index_of(face.points[c])];
    two.system.faces.push_back(copy);
  }
  const PackedGas packed(two);
  ASSERT_EQ(packed.plan.force_data.enclosures.enclosures.size(), 2u);
  EXPECT_NEAR(packed.volume(0), 8.0 * packed.volume(1), 1e-12);
}

// Faces from a hub to the edges of a ring, with or without spokes.
TestSim wheel(int corners, bool has_spokes) {
  TestSim sim = gas_ring(corners, 50.0, {});
  const PointId hub = sim.add({0.0, 0.0, 0.0}, 1.0);
  for (int i = 0; i < corners; ++i) {
    sim.system.faces.push_back({{hub, sim.system.points()[i].id, sim.system.points()[(i + 1) % corners].id}});
    if (i % 3 == 0) std::swap(sim.system.faces.back().points[0], sim.system.faces.back().points[1]);
    if (has_spokes) sim.join(hub, sim.system.points()[i].id, 10.0, 1.0);
  }
  return sim;
}

TEST(Enclosures, InFlatScenesTheBorderOfFacesIsALineAndSpringsInsideDoNotMatter) {
  for (const bool has_spokes : {false, true}) {
    const PackedGas packed(wheel(8, has_spokes));
    ASSERT_EQ(packed.plan.force_data.enclosures.enclosures.size(), 1u);
    EXPECT_NEAR(packed.volume(), 4.0 * std::sin(2.0 * gas_pi / 8.0), 1e-14);
    EXPECT_EQ(packed.force()[8], 0.0) << "the hub";
  }
  // without its faces it is not a line of two springs at every point
  TestSim open = wheel(8, true);
  open.system.faces.clear();
  EXPECT_TRUE(plan_enclosures(open.system).empty());
  // a border without a spring
  open = wheel(8, true);
  open.system.faces.pop_back();
  EXPECT_FALSE(plan_enclosures(open.system).empty()) << "two spokes close the gap";
  open = wheel(8, false);
  open.system.faces.pop_back();
  EXPECT_TRUE(plan_enclosures(open.system).empty());
  EXPECT_EQ(plan_enclosures(open.system).open, 1);
}

TEST(Enclosures, InFlatScenesHolesAreNotPartOfTheVolume) {
  constexpr int n = 6;
  TestSim sim = gas_ring(n, 50.0, {});
  std::vector<PointId> inner;
  for (int i = 0; i < n; ++i) inner.push_back(sim.add(0.5 * sim.state.position[i]));
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    const PointId a = sim.system.points()[i].id, b = sim.system.points()[next].id;
    sim.join(inner[i], inner[next], 50.0, 0.5);
    sim.system.faces.push_back({{a, b, inner[i]}});
    sim.system.faces.push_back({{b, inner[i], inner[next]}});
  }
  const PackedGas packed(sim);
  ASSERT_EQ(packed.plan.force_data.enclosures.enclosures.size(), 1u);
  EXPECT_NEAR(packed.volume(), 0.75 * 3.0 * std::sin(2.0 * gas_pi / n), 1e-14);
  EXPECT_NEAR(packed.plan.force_data.enclosures.enclosures[0].full_volume, 0.75 * n * n / (4.0 * gas_pi), 1e-14);
}

}  // namespace
}  // namespace hooke
