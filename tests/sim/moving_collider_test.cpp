// Moving colliders (along paths, by surface velocity, carried by the hand) against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/contact/contact.h"
#include "sim/contact/gap.h"
#include "sim/forces/energy/energy.h"
#include "sim/step/divergence.h"
#include "support/convergence.h"
#include "support/fall.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

// A point of radius 0.02 m at rest at the center of the top of a collider.
TestSim resting_on(const Collider& collider, const Vec3& place) {
  TestSim sim;
  sim.system.colliders = {collider};
  sim.add(place, 0.3);
  sim.system.point(0).radius = 0.02;
  return sim;
}
Collider floor_with(const ColliderPath& path, double friction) { return {.shape = Plane{}, .friction = friction, .path = path}; }

class Moving : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Moving, testing::ValuesIn(every_method()), method_name);

// the point slides until mu g t = v and then moves with the belt: x = v t - v^2 / (2 mu g), up to what it moves along the belt in the
// substep in which it stops on it, and half a substep further with symplectic Euler
TEST_P(Moving, ABeltAcceleratesAPointByFrictionUpToItsSpeed) {
  const double mu = 0.4, v = 1.5, reaches = v / (mu * g);
  for (const int substeps : {1, 7}) {
    TestSim sim = resting_on(floor_with({.belt = {v, 0.0, 0.0}}, mu), {0.0, 0.02, 0.0});
    const int before = static_cast<int>(reaches / frame_time);
    for (int i = 0; i < before; ++i) sim.run(method(), frame_time, substeps);
    EXPECT_NEAR(sim.state.velocity[0].x, mu * g * before * frame_time, 1e-11);
    for (int i = before; i < 60; ++i) sim.run(method(), frame_time, substeps);
    EXPECT_NEAR(sim.state.velocity[0].x, v, 1e-11);
    EXPECT_NEAR(sim.state.position[0].x, v * 1.0 - 0.5 * v * v / (mu * g),
                (method().is_symplectic() ? std::abs(method().velocity_lag) * v * frame_time / substeps : 0.0) +
                    0.125 * mu * g * std::pow(frame_time / substeps, 2) + 1e-10);
    EXPECT_NEAR(sim.state.position[0].y, 0.02, 1e-13);
  }
}

// The belt of a box has its own velocity too.
TEST_P(Moving, ABeltOnABoxMovesAlongItsSides) {
  TestSim sim =
      resting_on({.shape = Box{{-9.0, -1.0, -9.0}, {9.0, 0.0, 9.0}}, .friction = 1.0, .path = {.belt = {0.0, 3.0, 1.0}}}, {0.0, 0.02, 0.0});
  for (int i = 0; i < 30; ++i) sim.run(method(), frame_time, 2);
  EXPECT_NEAR(sim.state.velocity[0].z, 1.0, 1e-12);
  EXPECT_NEAR(sim.state.velocity[0].y, 0.0, 1e-12);  // the belt has no component along the normal of the top
}

// a plate that oscillates vertically with A omega^2 < g, so that nothing leaves it
TEST_P(Moving, APointStaysOnAVerticallyOscillatingPlate) {
  const ColliderPath path{.amplitude = {0.0, 0.1, 0.0}, .frequency = 1.3, .phase = 0.7};
  TestSim sim = resting_on(floor_with(path, 0.0), path.offset(0.0) + Vec3(0.0, 0.02, 0.0));
  sim.state.velocity[0] = path.velocity(0.0);
  for (int i = 0; i < 120; ++i) {
    sim.run(method(), frame_time, 5);
    EXPECT_NEAR(sim.state.position[0].y, path.offset(sim.state.time).y + 0.02, 1e-12);
    EXPECT_NEAR(sim.state.velocity[0].y, path.velocity(sim.state.time).y, 1e-9);
  }
}

// on a plate shaken horizontally the point moves along below the friction limit and slips beyond it
TEST_P(Moving, FrictionHoldsAPointOnAShakenPlateUpToItsLimit) {
  const ColliderPath path{.amplitude = {0.05, 0.0, 0.0}, .frequency = 2.0};
  const double peak_acceleration = 0.05 * std::pow(2.0 * std::numbers::pi * 2.0, 2.0) / g;  // the peak acceleration, in g
  for (const bool holds : {true, false}) {
    TestSim sim = resting_on(floor_with(path, peak_acceleration * (holds ? 1.01 : 0.9)), {0.0, 0.02, 0.0});
    sim.state.velocity[0] = path.velocity(0.0);
    double slip = 0.0;
    for (int i = 0; i < 60; ++i) {
      sim.run(method(), frame_time, 10);
      slip = std::max(slip, std::abs(sim.state.position[0].x - path.offset(sim.state.time).x));
    }
    if (holds) {
      EXPECT_LT(slip, 1e-12);
    } else {
      EXPECT_GT(slip, 1e-3);
    }
  }
}

// omega^2 r < mu g
TEST(Moving, ATurntableCarriesPointsUpToTheFrictionLimit) {
  const Integrator& verlet = *find_integrator("velocity_verlet");
  const double omega = 3.0, r = 0.4, mu = omega * omega * r / g;
  const auto error = [&](double friction, int steps) {
    TestSim sim = resting_on(floor_with({.spin = {0.0, omega, 0.0}}, friction), {r, 0.02, 0.0});
    sim.state.velocity[0] = {0.0, 0.0, -omega * r};
    sim.run(verlet, 1.0, steps);
    return glm::distance(sim.state.position[0], {r * std::cos(omega), 0.02, -r * std::sin(omega)});
  };
  expect_order([&](int steps) { return error(1.05 * mu, steps); }, 200, 2.0);
  EXPECT_LT(error(1.05 * mu, 400), 4e-5);
  EXPECT_GT(error(0.9 * mu, 400), 1e-2);
}

// A rotating ball drags a point on its top, which then loses contact; that part is not tested. On the equator of a ball that rotates about
// the vertical, a point held by a spring to the center moves with the surface.
TEST(Moving, ARotatingBallCarriesAPoint) {
  const Integrator& verlet = *find_integrator("velocity_verlet");
  const double omega = 2.0, contact_radius = 0.52;
  const auto error = [&](int steps) {
    TestSim sim =
        resting_on({.shape = Sphere{.radius = 0.5}, .friction = 1.0, .path = {.spin = {0.0, omega, 0.0}}}, {contact_radius, 0.0, 0.0});
    sim.system.gravity = Vec3(0.0);
    sim.state.velocity[0] = {0.0, 0.0, -omega * contact_radius};
    sim.join(sim.system.points()[0].id, sim.nail(Vec3(0.0)), 30.0, 0.1);
    sim.run(verlet, 1.0, steps);
    EXPECT_NEAR(gap_to(sim.system.colliders[0], 0.02, sim.state.position[0]).distance, 0.0, 1e-13);
    return glm::distance(sim.state.position[0], {contact_radius * std::cos(omega), 0.0, -contact_radius * std::sin(omega)});
  };
  expect_order(error, 200, 2.0);
  EXPECT_LT(error(400), 1e-4);
}

// v' = 2 w - v off a wall that approaches at w: the speed of the wall counts twice
TEST_P(Moving, ABounceOffAnApproachingWallGainsTwiceItsSpeed) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.system.colliders = {
      {.shape = Plane{{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, .restitution = 1.0, .path = {.amplitude = {5.0, 0.0, 0.0}, .frequency = 1e-3}}};
  const double w = sim.system.colliders[0].path.velocity(0.0).x;
  sim.add({0.0, 0.0, 0.0}, 1.0, {-2.0, 0.0, 0.0});
  for (int i = 0; i < 60; ++i) sim.run(method(), frame_time, 3);
  EXPECT_NEAR(sim.state.velocity[0].x, 2.0 + 2.0 * w, 1e-6);
}

// A collider carried by the hand moves at constant speed within a frame, and no point is left behind or inside.
TEST_P(Moving, ACarriedBallPushesPointsInItsPath) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.system.colliders = {{.shape = Sphere{.radius = 0.5}}};
  sim.add({0.8, 0.0, 0.0});
  sim.state.hand.collider = {.collider = 0, .shape = sim.system.colliders[0].shape, .target = {30.0, 0.0, 0.0}};
  Plan plan = make_plan(sim.system);
  Frame step;
  step.begin(plan, sim.system, {.integrator = &method(), .substeps = 3}, sim.state);
  while (!step.done()) step.substep(plan);
  step.end(plan, sim.state);
  EXPECT_NEAR(anchor_of(sim.state.hand.collider->shape).x, 30.0, 1e-12);
  EXPECT_NEAR(sim.state.position[0].x, 30.5, 1e-9);
  EXPECT_NEAR(sim.state.velocity[0].x, 30.0 * 60.0, 1e-6);
  // all its energy was supplied by the hand and is recorded in the ledger
  EXPECT_NEAR(sim.state.supply.net_input, compute_energy(sim.system, sim.state).total(), 1e-6 * sim.state.supply.net_input);
}

TEST(Moving, ACarriedColliderIsLimitedToTheMaximumSpeedOfTheHand) {
  TestSim sim;
  sim.system.colliders = {{.shape = Sphere{.radius = 0.5}}};
  sim.system.hand_speed = 6.0;
  sim.state.hand.collider = {.collider = 0, .shape = sim.system.colliders[0].shape, .target = {30.0, 0.0, 0.0}};
  Plan plan = make_plan(sim.system);
  Frame step;
  step.begin(plan, sim.system, {}, sim.state);
  while (!step.done()) step.substep(plan);
  step.end(plan, sim.state);
  EXPECT_NEAR(anchor_of(sim.state.hand.collider->shape).x, 0.1, 1e-15);
}

TEST(Moving, InTwoDimensionsStaysInThePlane) {
  TestSim sim =
      resting_on({.shape = Plane{}, .friction = 0.5, .path = {.amplitude = {0.1, 0.0, 3.0}, .belt = {1.0, 0.0, 5.0}}}, {0.0, 0.02, 0.0});
  sim.system.dimensions = 2;
  for (int i = 0; i < 60; ++i) sim.run(*find_integrator("velocity_verlet"), frame_time, 2);
  EXPECT_EQ(sim.state.position[0].z, 0.0);
  EXPECT_GT(sim.state.velocity[0].x, 0.1);
}

}  // namespace
}  // namespace hooke
