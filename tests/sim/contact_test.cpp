// Corner cases of contact: points inside colliders, corners, two dimensions, many colliders, and a cloth on a ball.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/contact/gap.h"
#include "sim/forces/energy/energy.h"
#include "sim/step/divergence.h"
#include "support/convergence.h"
#include "support/fall.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

class Contact : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Contact, testing::ValuesIn(every_method()), method_name);

using Shape = std::variant<Plane, Sphere, Box>;

// A point of `radius` at rest at x, with one collider.
TestSim point_and(const Shape& shape, const Vec3& x, double radius) {
  TestSim sim;
  sim.add(x);
  sim.system.point(0).radius = radius;
  sim.system.colliders = {{.shape = shape, .restitution = 0.5, .friction = 1.0}};
  return sim;
}

TEST_P(Contact, PushesPointsThatStartInsideToTheNearestSurface) {
  for (const double radius : {0.0, 0.05}) {
    TestSim plane = point_and(Plane{}, {0.3, -0.4, 0.1}, radius);
    TestSim ball = point_and(Sphere{.center = {0.0, 1.0, 0.0}, .radius = 0.5}, {0.0, 1.1, 0.0}, radius);
    TestSim box = point_and(Box{.min = Vec3(-1.0), .max = Vec3(1.0)}, {0.2, 0.9, 0.1}, radius);
    for (TestSim* sim : {&plane, &ball, &box})
      for (int i = 0; i < 10; ++i) sim->run(method(), frame_time, 2);
    EXPECT_LT(glm::distance(plane.state.position[0], Vec3(0.3, radius, 0.1)), 1e-13);
    EXPECT_LT(glm::distance(ball.state.position[0], Vec3(0.0, 1.5 + radius, 0.0)), 1e-13);
    EXPECT_LT(glm::distance(box.state.position[0], Vec3(0.2, 1.0 + radius, 0.1)), 1e-13);
    for (const TestSim* sim : {&plane, &ball, &box}) EXPECT_EQ(sim->state.velocity[0], Vec3(0.0));
  }
}

TEST_P(Contact, AtTheCenterOfABallPushesUp) {
  TestSim sim = point_and(Sphere{.center = {0.1, 0.2, 0.3}, .radius = 0.5}, {0.1, 0.2, 0.3}, 0.0);
  sim.run(method(), frame_time, 1);
  EXPECT_LT(glm::distance(sim.state.position[0], Vec3(0.1, 0.7, 0.3)), 1e-13);
}

TEST_P(Contact, IgnoresNailsAndTheHeldPoint) {
  TestSim sim;
  sim.system.colliders = {{.shape = Plane{}}};
  const PointId nailed = sim.nail({0.0, -0.5, 0.0}), held = sim.add({0.0, 0.1, 0.0});
  sim.system.grab = Grab{.point = held, .kind = GrabKind::Hold};
  sim.state.hand.target = {1.0, -0.4, 0.0};
  sim.run(method(), frame_time, 3);
  EXPECT_EQ(sim.position(nailed), Vec3(0.0, -0.5, 0.0));
  EXPECT_EQ(sim.position(held), Vec3(1.0, -0.4, 0.0));
}

TEST_P(Contact, IgnoresCollidersThatAreOnlyDrawn) {
  TestSim sim = point_and(Plane{}, {0.0, 0.001, 0.0}, 0.0);
  sim.system.colliders[0].solid = false;
  sim.run(method(), 0.5, 30);
  EXPECT_LT(sim.state.position[0].y, -1.0);
}

// in two dimensions a ball behind the plane is a disc in the plane, and an inclined wall becomes vertical
TEST_P(Contact, InTwoDimensionsStaysInThePlane) {
  const std::vector<Shape> shapes = {Sphere{.center = {0.02, 0.0, 0.4}, .radius = 0.5},
                                     Plane{.normal = glm::normalize(Vec3(0.1, 1.0, 1.0))},
                                     Box{.min = {-1.0, -1.0, 0.5}, .max = {0.3, 0.5, 1.0}}};
  for (const Shape& shape : shapes) {
    TestSim sim = point_and(shape, {0.0, 1.0, 0.0}, 0.01);
    sim.system.dimensions = 2;
    for (int i = 0; i < 30; ++i) sim.run(method(), frame_time, 1);
    EXPECT_EQ(sim.state.position[0].z, 0.0);
    EXPECT_EQ(sim.state.velocity[0].z, 0.0);
    EXPECT_GT(sim.state.position[0].y, -0.1) << "shape " << shape.index();
  }
  TestSim sim = point_and(Plane{.point = {0.0, 0.0, 0.1}, .normal = {0.0, 0.0, 1.0}}, {0.0, 1.0, 0.0}, 0.01);
  sim.system.dimensions = 2;
  sim.run(method(), 0.5, 30);
  EXPECT_LT(sim.state.position[0].y, 0.0);
}

TEST_P(Contact, WithManyCollidersStaysFinite) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Random random(seed);
    const auto vector = [&](double size) {
      const double x = random.uniform(-size, size), y = random.uniform(-size, size), z = random.uniform(-size, size);
      return Vec3(x, y, z);
    };
    TestSim sim;
    for (int i = 0; i < 12; ++i) {
      const Vec3 x = vector(1.0);
      const double size = random.uniform(0.01, 0.5), restitution = random.uniform(0.0, 1.0), friction = random.uniform(0.0, 2.0);
      Shape shape = Sphere{.center = x, .radius = size};
      if (i % 3 == 0) shape = Box{.min = x - Vec3(size), .max = x + Vec3(size)};
      if (i % 3 == 1)
        shape = Plane{.point = vector(0.1) - Vec3(0.0, 2.0, 0.0), .normal = glm::normalize(vector(0.5) + Vec3(0.0, 1.0, 0.0))};
      sim.system.colliders.push_back({.shape = shape, .restitution = restitution, .friction = friction});
    }
    for (int i = 0; i < 20; ++i) {
      const Vec3 x = vector(1.0), v = vector(20.0);
      sim.add(x, 1.0, v);
      sim.system.point(i).radius = i % 2 == 0 ? 0.0 : 0.05;
      if (i > 0 && i % 4 == 0) sim.join(sim.system.points()[i].id, sim.system.points()[i - 1].id, 100.0, 0.5, 0.5);
    }
    for (int f = 0; f < 120; ++f) sim.run(method(), frame_time, 8);
    EXPECT_TRUE(is_finite(sim.state)) << "seed " << seed;
    for (const Vec3& x : sim.state.position) EXPECT_GT(x.y, -20.0) << "seed " << seed;
  }
}

// A cloth dropped onto a ball: no point penetrates the ball, and the energy does not increase.
TEST(Contact, BetweenAClothAndABallAddsNoEnergy) {
  constexpr int n = 12;
  TestSim sim;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) sim.add({0.1 * column, 0.4, 0.1 * row}, 0.01);
  for (int i = 0; i < n * n; ++i) {
    const auto join = [&](int to) {
      const double length = glm::distance(sim.state.position[i], sim.state.position[to]);
      sim.join(sim.system.points()[i].id, sim.system.points()[to].id, 100.0, length, 0.02);
    };
    if (i % n + 1 < n) join(i + 1);
    if (i / n + 1 < n) join(i + n);
    if (i % n + 1 < n && i / n + 1 < n) join(i + n + 1);
    if (i % n > 0 && i / n + 1 < n) join(i + n - 1);
  }
  sim.system.colliders = {{.shape = Sphere{.center = {0.55, 0.0, 0.55}, .radius = 0.3}, .restitution = 0.2, .friction = 0.5},
                          {.shape = Plane{.point = {0.0, -0.6, 0.0}}, .restitution = 0.2, .friction = 0.5}};
  const double start = compute_energy(sim.system, sim.state).total();
  double min = start;
  for (int f = 0; f < 240; ++f) {
    sim.run(default_integrator(), frame_time, 20);
    const double energy = compute_energy(sim.system, sim.state).total();
    ASSERT_LT(energy, min + 1e-3 * std::abs(start)) << "frame " << f;
    min = std::min(min, energy);
    for (const Vec3& x : sim.state.position)
      for (const Collider& collider : sim.system.colliders) ASSERT_GT(gap_to(collider, 0.0, x).distance, -1e-12) << "frame " << f;
  }
}

}  // namespace
}  // namespace hooke
