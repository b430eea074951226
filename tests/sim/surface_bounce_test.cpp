// Impacts with restitution of what touches faces and springs.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/energy/energy.h"
#include "support/convergence.h"
#include "support/folds.h"

namespace hooke {
namespace {

constexpr double g_of_bounces = 9.81, frame_of_bounces = 1.0 / 60.0;

PointId add_ball(TestSim& sim, const Vec3& position, double mass = 0.2, const Vec3& velocity = Vec3(0.0)) {
  const PointId id = sim.add(position, mass, velocity);
  sim.system.point(sim.system.index_of(id)).radius = 0.05;
  return id;
}

// A ball of 0.05 m at this height above what touches it: a nailed face, or a nailed spring in two dimensions.
TestSim ball_above(bool is_face, double height, double restitution) {
  TestSim sim;
  sim.system.gravity = {0.0, -g_of_bounces, 0.0};
  sim.system.contact = {.springs = !is_face, .faces = is_face, .thickness = 0.01, .restitution = restitution};
  add_ball(sim, {0.02, 0.06 + height, 0.0});
  const double z = is_face ? -0.1 : 0.0;
  const PointId left = sim.nail({-0.1, 0.0, z}), right = sim.nail({0.1, 0.0, z});
  if (is_face) {
    sim.system.faces.push_back({{left, right, sim.nail({0.0, 0.0, 0.2})}});
  } else {
    sim.system.dimensions = 2;
    sim.join(left, right, 100.0, 0.2);
  }
  return sim;
}

class SurfaceBounceOf : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, SurfaceBounceOf, testing::ValuesIn(every_method()), method_name);

// The ball rebounds with e times the velocity of the impact: to e^2 times the height.
TEST_P(SurfaceBounceOf, RisesToTheSquareOfTheRestitutionOnFacesAndSprings) {
  for (const bool is_face : {true, false})
    for (const double restitution : {0.3, 0.7, 1.0}) {
      constexpr double height = 0.3;
      TestSim sim = ball_above(is_face, height, restitution);
      const double fall = std::sqrt(2.0 * height / g_of_bounces), flight = 2.0 * restitution * fall;
      double highest = -1.0;
      for (int i = 0; i * frame_of_bounces < fall + flight; ++i) {
        sim.run(method(), frame_of_bounces, 60);
        if (i * frame_of_bounces > fall) highest = std::max(highest, sim.state.position[0].y - 0.06);
      }
      // the highest place at the end of a frame
      const double missed = 0.5 * g_of_bounces * std::pow(0.5 * frame_of_bounces, 2);
      EXPECT_GT(highest, restitution * restitution * height - missed - 1e-4) << is_face << ", e = " << restitution;
      EXPECT_LT(highest, restitution * restitution * height + 1e-4) << is_face << ", e = " << restitution;
    }
}

TEST_P(SurfaceBounceOf, EndsInRest) {
  for (const bool is_face : {true, false}) {
    TestSim sim = ball_above(is_face, 0.05, 0.5);
    for (int i = 0; i < 40; ++i) sim.run(method(), frame_of_bounces, 20);
    EXPECT_NEAR(sim.state.position[0].y, 0.06, 1e-5) << is_face;
    const bool lags = &method() == find_integrator("explicit_euler");  // as without restitution
    EXPECT_NEAR(sim.state.velocity[0].y, 0.0, lags ? 9.82 * frame_of_bounces / 20 : 1e-6) << is_face;
  }
}

// J = (1 + e) v / (1/M + 1/(3 m)) at the center of a free face.
TEST_P(SurfaceBounceOf, HitsAFreeFaceAsTheClosedForm) {
  for (const double restitution : {0.0, 0.6, 1.0}) {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    std::array<PointId, 3> face;
    for (int i = 0; i < 3; ++i)
      face[i] = sim.add({std::cos(2.0 * std::numbers::pi / 3.0 * i), 0.0, std::sin(2.0 * std::numbers::pi / 3.0 * i)}, 0.3);
    sim.system.faces.push_back({face});
    sim.system.contact = {.faces = true, .thickness = 0.01, .restitution = restitution};
    const PointId ball = add_ball(sim, {0.0, 0.2, 0.0}, 0.2, {0.0, -2.0, 0.0});
    const double energy = compute_energy(sim.system, sim.state).kinetic;
    for (int i = 0; i < 8; ++i) sim.run(method(), frame_of_bounces, 50);
    const double impulse = (1.0 + restitution) * 2.0 / (1.0 / 0.2 + 1.0 / 0.9);
    EXPECT_NEAR(sim.velocity(ball).y, -2.0 + impulse / 0.2, 1e-6);
    for (const PointId id : face) EXPECT_NEAR(sim.velocity(id).y, -impulse / 0.9, 1e-6);
    const double loss = 0.5 * (1.0 - restitution * restitution) * 4.0 / (1.0 / 0.2 + 1.0 / 0.9);
    EXPECT_NEAR(compute_energy(sim.system, sim.state).kinetic, energy - loss, 1e-6);
  }
}

// The Coulomb impulse of compression and rebound: mu (1 + e) v.
TEST_P(SurfaceBounceOf, HasFrictionOfBothImpulses) {
  for (const bool is_face : {true, false}) {
    TestSim sim = ball_above(is_face, 0.02, 0.5);
    sim.system.gravity = Vec3(0.0);
    sim.system.contact.friction = 0.2;
    sim.state.velocity[0] = {1.5, -2.0, 0.0};
    sim.run(method(), frame_of_bounces, 60);
    EXPECT_NEAR(sim.state.velocity[0].y, 1.0, 1e-9) << is_face;
    EXPECT_NEAR(sim.state.velocity[0].x, 1.5 - 0.2 * 1.5 * 2.0, 1e-9) << is_face;
  }
}

// The motion continues at the end of the substep of the impact: it is late by less than one.
TEST_P(SurfaceBounceOf, IsLateByLessThanASubstep) {
  for (const int substeps : {20, 60, 200}) {
    TestSim sim = ball_above(true, 0.02, 0.8);
    sim.system.gravity = Vec3(0.0);
    sim.state.velocity[0] = {0.0, -2.0, 0.0};
    sim.run(method(), frame_of_bounces, substeps);
    const double exact = 0.06 + 1.6 * (frame_of_bounces - 0.01), late = exact - sim.state.position[0].y;
    EXPECT_GT(late, -1e-9) << substeps;
    EXPECT_LT(late, 1.6 * frame_of_bounces / substeps + 1e-9) << substeps;
  }
}

// A stick turns so far in one substep that its nearest point flies away from a ball, and its other half hits it: only continuous collision
// detection finds that, and an elastic impact is inelastic. In short substeps it is elastic.
TEST(SurfaceBounce, DoesNotReboundFromWhatOnlyContinuousCollisionDetectionFinds) {
  for (const int substeps : {1, 400}) {
    TestSim sim;
    sim.system.dimensions = 2;
    sim.system.gravity = Vec3(0.0);
    sim.system.contact = {.springs = true, .thickness = 0.01, .restitution = 1.0, .friction = 0.0};
    add_ball(sim, {0.3, 0.05, 0.0});
    const PointId left = sim.add({-0.2, 0.0, 0.0}, 0.1, Vec3{0.8, 0.1, 0.0} / frame_of_bounces);
    const PointId right = sim.add({0.2, 0.0, 0.0}, 0.1, Vec3{0.0, -0.5, 0.0} / frame_of_bounces);
    sim.join(left, right, 0.01, 0.4);
    const double energy = compute_energy(sim.system, sim.state).kinetic;
    sim.run(default_integrator(), frame_of_bounces, substeps);
    const double ratio = compute_energy(sim.system, sim.state).kinetic / energy;
    EXPECT_GT(glm::length(sim.state.velocity[0]), 1.0) << "it is hit";
    if (substeps == 1) {
      EXPECT_LT(ratio, 0.9);
    } else {
      EXPECT_NEAR(ratio, 1.0, 1e-3);
    }
  }
}

// At many places at once: elastic impacts conserve momentum, and gain no energy; they lose some, because sweeps are few.
TEST_P(SurfaceBounceOf, KeepsMomentumAndEnergyAtManyPlaces) {
  TestSim sim = colliding_sheets(9);
  folds::touch(sim, 0.0);
  sim.system.contact.restitution = 1.0;
  add_ball(sim, {0.1, 0.03, 0.3}, 0.1, {0.5, 0.0, -20.0});
  add_ball(sim, {-0.2, 0.03, -0.3}, 0.01, {0.0, 0.0, 30.0});
  const bool diverges = method().stability == Stability::None;
  const Vec3 momentum = compute_momentum(sim.system, sim.state).linear;
  const double energy = compute_energy(sim.system, sim.state).total();
  for (int i = 0; i < (diverges ? 3 : 6); ++i) {
    sim.run(method(), frame_of_bounces, 200);
    EXPECT_LT(glm::distance(compute_momentum(sim.system, sim.state).linear, momentum), 1e-11);
    const double ratio = compute_energy(sim.system, sim.state).total() / energy;
    if (!diverges) {
      EXPECT_LT(ratio, 1.005) << "frame " << i;
    }
    // the others damp vibrations
    if (method().energy == EnergyTrend::Bounded || method().energy == EnergyTrend::Drifts) {
      EXPECT_GT(ratio, 0.9) << "frame " << i;
    }
  }
}

}  // namespace
}  // namespace hooke
