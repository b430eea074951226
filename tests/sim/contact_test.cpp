// Corner cases of contact: points inside colliders, corners, two dimensions, many colliders, and a cloth on a ball.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/contact/gap.h"
#include "sim/divergence.h"
#include "sim/energy.h"
#include "support/convergence.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

constexpr double frame = 1.0 / 60.0;

class Contact : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Contact, testing::ValuesIn(every_method()), method_name);

using Shape = std::variant<Plane, Sphere, Box>;

// A point of `radius` at rest at x, with one collider.
Trial point_and(const Shape& shape, const Vec3& x, double radius) {
  Trial trial;
  trial.add(x);
  trial.system.point(0).radius = radius;
  trial.system.colliders = {{.shape = shape, .restitution = 0.5, .friction = 1.0}};
  return trial;
}

TEST_P(Contact, PushesPointsThatStartInsideToTheNearestSurface) {
  for (const double radius : {0.0, 0.05}) {
    Trial plane = point_and(Plane{}, {0.3, -0.4, 0.1}, radius);
    Trial ball = point_and(Sphere{.center = {0.0, 1.0, 0.0}, .radius = 0.5}, {0.0, 1.1, 0.0}, radius);
    Trial box = point_and(Box{.min = Vec3(-1.0), .max = Vec3(1.0)}, {0.2, 0.9, 0.1}, radius);
    for (Trial* trial : {&plane, &ball, &box})
      for (int i = 0; i < 10; ++i) trial->run(method(), frame, 2);
    EXPECT_LT(glm::distance(plane.state.position[0], Vec3(0.3, radius, 0.1)), 1e-13);
    EXPECT_LT(glm::distance(ball.state.position[0], Vec3(0.0, 1.5 + radius, 0.0)), 1e-13);
    EXPECT_LT(glm::distance(box.state.position[0], Vec3(0.2, 1.0 + radius, 0.1)), 1e-13);
    for (const Trial* trial : {&plane, &ball, &box}) EXPECT_EQ(trial->state.velocity[0], Vec3(0.0));
  }
}

TEST_P(Contact, AtTheCenterOfABallPushesUp) {
  Trial trial = point_and(Sphere{.center = {0.1, 0.2, 0.3}, .radius = 0.5}, {0.1, 0.2, 0.3}, 0.0);
  trial.run(method(), frame, 1);
  EXPECT_LT(glm::distance(trial.state.position[0], Vec3(0.1, 0.7, 0.3)), 1e-13);
}

TEST_P(Contact, IgnoresNailsAndTheHeldPoint) {
  Trial trial;
  trial.system.colliders = {{.shape = Plane{}}};
  const PointId nailed = trial.nail({0.0, -0.5, 0.0}), held = trial.add({0.0, 0.1, 0.0});
  trial.system.grab = Grab{.point = held, .kind = GrabKind::Hold};
  trial.state.hand.target = {1.0, -0.4, 0.0};
  trial.run(method(), frame, 3);
  EXPECT_EQ(trial.position(nailed), Vec3(0.0, -0.5, 0.0));
  EXPECT_EQ(trial.position(held), Vec3(1.0, -0.4, 0.0));
}

TEST_P(Contact, IgnoresCollidersThatAreOnlyDrawn) {
  Trial trial = point_and(Plane{}, {0.0, 0.001, 0.0}, 0.0);
  trial.system.colliders[0].solid = false;
  trial.run(method(), 0.5, 30);
  EXPECT_LT(trial.state.position[0].y, -1.0);
}

// in two dimensions a ball behind the plane is a disc in the plane, and an inclined wall becomes vertical
TEST_P(Contact, InTwoDimensionsStaysInThePlane) {
  const std::vector<Shape> shapes = {Sphere{.center = {0.02, 0.0, 0.4}, .radius = 0.5},
                                     Plane{.normal = glm::normalize(Vec3(0.1, 1.0, 1.0))},
                                     Box{.min = {-1.0, -1.0, 0.5}, .max = {0.3, 0.5, 1.0}}};
  for (const Shape& shape : shapes) {
    Trial trial = point_and(shape, {0.0, 1.0, 0.0}, 0.01);
    trial.system.dimensions = 2;
    for (int i = 0; i < 30; ++i) trial.run(method(), frame, 1);
    EXPECT_EQ(trial.state.position[0].z, 0.0);
    EXPECT_EQ(trial.state.velocity[0].z, 0.0);
    EXPECT_GT(trial.state.position[0].y, -0.1) << "shape " << shape.index();
  }
  Trial trial = point_and(Plane{.point = {0.0, 0.0, 0.1}, .normal = {0.0, 0.0, 1.0}}, {0.0, 1.0, 0.0}, 0.01);
  trial.system.dimensions = 2;
  trial.run(method(), 0.5, 30);
  EXPECT_LT(trial.state.position[0].y, 0.0);
}

TEST_P(Contact, WithManyCollidersStaysFinite) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Random random(seed);
    const auto vector = [&](double size) {
      const double x = random.uniform(-size, size), y = random.uniform(-size, size), z = random.uniform(-size, size);
      return Vec3(x, y, z);
    };
    Trial trial;
    for (int i = 0; i < 12; ++i) {
      const Vec3 x = vector(1.0);
      const double size = random.uniform(0.01, 0.5), restitution = random.uniform(0.0, 1.0), friction = random.uniform(0.0, 2.0);
      Shape shape = Sphere{.center = x, .radius = size};
      if (i % 3 == 0) shape = Box{.min = x - Vec3(size), .max = x + Vec3(size)};
      if (i % 3 == 1)
        shape = Plane{.point = vector(0.1) - Vec3(0.0, 2.0, 0.0), .normal = glm::normalize(vector(0.5) + Vec3(0.0, 1.0, 0.0))};
      trial.system.colliders.push_back({.shape = shape, .restitution = restitution, .friction = friction});
    }
    for (int i = 0; i < 20; ++i) {
      const Vec3 x = vector(1.0), v = vector(20.0);
      trial.add(x, 1.0, v);
      trial.system.point(i).radius = i % 2 == 0 ? 0.0 : 0.05;
      if (i > 0 && i % 4 == 0) trial.join(trial.system.points()[i].id, trial.system.points()[i - 1].id, 100.0, 0.5, 0.5);
    }
    for (int f = 0; f < 120; ++f) trial.run(method(), frame, 8);
    EXPECT_TRUE(is_finite(trial.state)) << "seed " << seed;
    for (const Vec3& x : trial.state.position) EXPECT_GT(x.y, -20.0) << "seed " << seed;
  }
}

// A cloth dropped onto a ball: no point penetrates the ball, and the energy does not increase.
TEST(Contact, BetweenAClothAndABallAddsNoEnergy) {
  constexpr int n = 12;
  Trial trial;
  for (int i = 0; i < n * n; ++i) trial.add({0.1 * (i % n), 0.4, 0.1 * (i / n)}, 0.01);
  for (int i = 0; i < n * n; ++i) {
    const auto join = [&](int to) {
      const double length = glm::distance(trial.state.position[i], trial.state.position[to]);
      trial.join(trial.system.points()[i].id, trial.system.points()[to].id, 100.0, length, 0.02);
    };
    if (i % n + 1 < n) join(i + 1);
    if (i / n + 1 < n) join(i + n);
    if (i % n + 1 < n && i / n + 1 < n) join(i + n + 1);
    if (i % n > 0 && i / n + 1 < n) join(i + n - 1);
  }
  trial.system.colliders = {{.shape = Sphere{.center = {0.55, 0.0, 0.55}, .radius = 0.3}, .restitution = 0.2, .friction = 0.5},
                            {.shape = Plane{.point = {0.0, -0.6, 0.0}}, .restitution = 0.2, .friction = 0.5}};
  const double start = compute_energy(trial.system, trial.state).total();
  double min = start;
  for (int f = 0; f < 240; ++f) {
    trial.run(default_integrator(), frame, 20);
    const double energy = compute_energy(trial.system, trial.state).total();
    ASSERT_LT(energy, min + 1e-3 * std::abs(start)) << "frame " << f;
    min = std::min(min, energy);
    for (const Vec3& x : trial.state.position)
      for (const Collider& collider : trial.system.colliders) ASSERT_GT(gap_to(collider, 0.0, x).distance, -1e-12) << "frame " << f;
  }
}

}  // namespace
}  // namespace hooke
