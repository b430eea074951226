// Points that start inside each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "sim/forces/energy/energy.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

double energy_of(const TestSim& sim) { return compute_energy(sim.system, sim.state).total(); }

// 2 to 7 points within each other's reach, with and without restitution and friction; springs that press them together and apart, all
// longer at rest than what touches.
TestSim overlapping_net(std::uint64_t seed) {
  Random random(seed * 77 + 5);
  TestSim sim;
  sim.system.dimensions = random.one_in(2) ? 2 : 3;
  sim.system.gravity = Vec3(0.0);
  const double restitution = random.one_in(2) ? 0.0 : random.uniform(0.0, 1.0),
               friction = random.one_in(2) ? 0.0 : random.uniform(0.0, 1.0);
  sim.system.contact = {.points = true, .restitution = restitution, .friction = friction};
  const Index points = 2 + random.below(6);
  for (Index i = 0; i < points; ++i) {
    const double x = random.uniform(-0.3, 0.3), y = random.uniform(-0.3, 0.3), z = random.uniform(-0.3, 0.3);
    sim.add({x, y, sim.system.dimensions == 3 ? z : 0.0}, random.uniform(0.1, 2.0));
    sim.system.point(i).radius = random.uniform(0.02, 0.2);
    sim.system.point(i).nailed = random.one_in(5);
  }
  for (Index s = 0; s < points; ++s) {
    const Index i = random.below(points), j = (i + 1 + random.below(points - 1)) % points;
    const Point &first = sim.system.points()[i], &second = sim.system.points()[j];
    const double touching = first.radius + second.radius, distance = glm::distance(sim.state.position[i], sim.state.position[j]);
    const double stiffness = std::pow(10.0, random.uniform(1.0, 4.0)), factor = random.uniform(0.3, 2.0);
    sim.join(first.id, second.id, stiffness, std::max(1.05 * touching, factor * (random.one_in(2) ? touching : distance)));
  }
  return sim;
}

// To separate what springs press together takes work, which is done once: the energy does not grow without bounds.
TEST(Overlaps, TakeUpAtMostAFewTimesTheEnergyOfTheStart) {
  for (const char* method : {"velocity_verlet", "runge_kutta4"}) {
    int gaining = 0;
    double largest = 0.0;
    for (std::uint64_t seed = 0; seed < 80; ++seed) {
      TestSim sim = overlapping_net(seed);
      const double start = energy_of(sim);
      double gain = 0.0;  // [1], of the energy at the start
      for (int i = 0; i < 60; ++i) {
        sim.run(*find_integrator(method), 1.0 / 60.0, 60);
        gain = std::max(gain, (energy_of(sim) - start) / (start + 1e-6));
        ASSERT_LT(gain, 2.0) << method << ", scene " << seed << ", frame " << i;
      }
      gaining += gain > 1e-3 ? 1 : 0;
      largest = std::max(largest, gain);
    }
    if (std::getenv("HOOKE_PRINT") != nullptr)
      std::printf("%s: %d of 80 nets gain more than 0.1 %%, at most %.3g times the energy at the start\n", method, gaining, largest);
  }
}

TEST(Overlaps, ThatASpringPressesSeparateInPart) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.system.contact = {.points = true};
  const PointId nail = sim.nail({0.0, 0.0, 0.0}), ball = sim.add({0.15, 0.0, 0.0});
  for (const Index i : {0, 1}) sim.system.point(i).radius = 0.1;
  sim.join(ball, sim.nail({-1.0, 0.0, 0.0}), 1000.0, 0.2);
  sim.join(ball, nail, 10.0, 0.21);
  for (int i = 0; i < 60; ++i) sim.run(default_integrator(), 1.0 / 60.0, 20);
  EXPECT_GT(sim.position(ball).x, 0.15);
  EXPECT_LT(sim.position(ball).x, 0.2 - 1e-3);
}

// The same springs, stretched: as soon as nothing presses the points together, they separate, and then they touch.
TEST(Overlaps, EndWhereSpringsPullThemApart) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.system.contact = {.points = true};
  const PointId first = sim.add({0.0, 0.0, 0.0}), second = sim.add({0.15, 0.0, 0.0});
  for (const Index i : {0, 1}) sim.system.point(i).radius = 0.1;
  sim.join(first, second, 200.0, 0.25);
  double last = 0.0;
  for (int i = 0; i < 120; ++i) {
    sim.run(default_integrator(), 1.0 / 60.0, 20);
    last = glm::distance(sim.position(first), sim.position(second));
    if (i > 10) {
      EXPECT_GT(last, 0.2 - 1e-9) << i;
    }
  }
}

// A heap of balls that starts inside each other spreads, against gravity alone.
TEST(Overlaps, OfAHeapUnderGravitySeparate) {
  TestSim sim;
  sim.system.contact = {.points = true};
  sim.system.colliders = {{.shape = Plane{}}};
  sim.system.dimensions = 2;
  for (int i = 0; i < 3; ++i) {
    sim.add({0.0, 0.05 + 0.08 * i, 0.0}, 0.2);
    sim.system.point(i).radius = 0.05;
  }
  for (int i = 0; i < 180; ++i) sim.run(default_integrator(), 1.0 / 60.0, 2);
  for (int i = 0; i < 2; ++i) EXPECT_GT(sim.state.position[i + 1].y - sim.state.position[i].y, 0.09) << i;
}

}  // namespace
}  // namespace hooke
