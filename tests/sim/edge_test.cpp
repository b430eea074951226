// Points that slide over the edges of blocks: where within a substep they leave.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "support/convergence.h"
#include "support/fall.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

// A block below y = 0 up to x = 0, and a point on it.
TestSim on_block(double x, double radius, double speed, double friction = 0.0) {
  TestSim sim;
  sim.system.colliders = {{.shape = Box{.min = {-5.0, -1.0, -1.0}, .max = {0.0, 0.0, 1.0}}, .restitution = 0.5, .friction = friction}};
  sim.add({x, radius, 0.3}, 0.7, {speed, 0.0, 0.0});
  sim.system.point(0).radius = radius;
  return sim;
}

void run_frames(TestSim& sim, const Integrator& method, int frames, int substeps) {
  for (int i = 0; i < frames; ++i) sim.run(method, frame_time, substeps);
}

class Edge : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Edge, testing::ValuesIn(every_method()), method_name);

// A slide up to the edge, then a free fall. A point leaves the edge at the end of its substep, what has a radius up to one later.
TEST_P(Edge, APointFallsFromWhereTheFaceEnds) {
  for (const double radius : {0.0, 0.02})
    for (const double speed : {1.0, 1.5, 1.6, 2.3})
      for (const int substeps : {1, 7}) {
        TestSim sim = on_block(-0.7, radius, speed);
        constexpr int frames = 60;
        run_frames(sim, method(), frames, substeps);
        const double fall = frames * frame_time - 0.7 / speed;
        const double late = (radius > 0.0 || method().order == 1 ? 2.0 : 1.0) * frame_time / substeps, tolerance = g * fall * late;
        EXPECT_NEAR(sim.state.position[0].x, frames * frame_time * speed - 0.7, 1e-10) << radius << ' ' << speed << ' ' << substeps;
        EXPECT_NEAR(sim.state.position[0].y, radius - 0.5 * g * fall * fall, tolerance) << radius << ' ' << speed << ' ' << substeps;
        EXPECT_NEAR(sim.state.velocity[0].y, -g * fall, g * late + 1e-10) << radius << ' ' << speed << ' ' << substeps;
      }
}

// The same over any side of a block.
TEST(Edges, AllEndWhereTheyAre) {
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0.6, 0, 0.8)})
    for (const double radius : {0.0, 0.02}) {
      TestSim sim;
      sim.system.colliders = {{.shape = Box{.min = {-0.5, -1.0, -0.5}, .max = {0.5, 0.0, 0.5}}, .restitution = 0.0, .friction = 0.0}};
      sim.add({0.0, radius, 0.0}, 0.7, 1.7 * direction);
      sim.system.point(0).radius = radius;
      run_frames(sim, *find_integrator("velocity_verlet"), 30, 1);
      const double slide = 0.5 / std::max(std::abs(direction.x), std::abs(direction.z)) / 1.7, fall = 0.5 - slide;
      EXPECT_NEAR(sim.state.position[0].y, radius - 0.5 * g * fall * fall, 2.0 * g * fall * frame_time) << radius;
    }
}

// Friction acts up to the edge: v^2 = v0^2 - 2 mu g s.
TEST(Edges, FrictionEndsWithTheFace) {
  for (const double radius : {0.0, 0.02}) {
    constexpr double mu = 0.2, speed = 2.0, length = 0.7;
    TestSim sim = on_block(-length, radius, speed, mu);
    run_frames(sim, *find_integrator("velocity_verlet"), 60, 1);
    const double left = std::sqrt(speed * speed - 2.0 * mu * g * length), fall = 1.0 - (speed - left) / (mu * g);
    EXPECT_NEAR(sim.state.velocity[0].x, left, 2.0 * mu * g * frame_time);
    EXPECT_NEAR(sim.state.position[0].y, radius - 0.5 * g * fall * fall, 2.0 * g * fall * frame_time);
  }
}

// On a cylinder, as on a ball of the same radius: to second order, and whatever the velocity along the edge.
TEST(Edges, APointWithARadiusGoesRoundThem) {
  constexpr double radius = 0.2, angle = 0.1, speed = 0.3, along_edge = 0.4;
  constexpr int frames = 12;
  const Vec3 start = radius * Vec3(std::sin(angle), std::cos(angle), 0.0), around = speed * Vec3(std::cos(angle), -std::sin(angle), 0.0);
  const Integrator& method = *find_integrator("velocity_verlet");
  TestSim ball;
  ball.system.colliders = {{.shape = Sphere{.radius = radius}}};
  ball.add(start, 0.7, around);
  run_frames(ball, method, frames, 1000);
  EXPECT_NEAR(glm::length(ball.state.position[0]), radius, 1e-12);  // it is still there

  const auto on_edge = [&](double z_velocity, int substeps) {
    TestSim sim = on_block(0.0, radius, 0.0);
    sim.state.position[0] = start;
    sim.state.velocity[0] = around + Vec3(0.0, 0.0, z_velocity);
    run_frames(sim, method, frames, substeps);
    return sim.state.position[0];
  };
  expect_order([&](int n) { return glm::distance(on_edge(0.0, n), ball.state.position[0]); }, 10, 2.0);
  EXPECT_LT(glm::distance(on_edge(along_edge, 10), on_edge(0.0, 10) + Vec3(0.0, 0.0, along_edge * frames * frame_time)), 1e-12);
}

}  // namespace
}  // namespace hooke
