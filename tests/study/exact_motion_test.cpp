// Ghosts against closed forms. Symbols: m mass, k stiffness, d damping, c drag.
#include "study/check/exact_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/control/frame_error.h"
#include "sim/methods/integrator.h"
#include "study/forecast.h"
#include "support/nets.h"

namespace hooke {
namespace {

constexpr double g = 9.81, pi = std::numbers::pi;

std::optional<Companion> exact_of(const TestSim& sim) { return exact_companion(std::make_shared<const System>(sim.system), sim.state); }

State after(const Companion& companion, State state, double seconds) {
  constexpr int frames = 7;
  for (int frame = 0; frame < frames; ++frame) companion.exact(state, seconds / frames);
  return state;
}

TEST(ExactMotion, OfAMassOnADampedSpring) {
  // y = -l0 - m g / k + e^(-b t) (A cos w t + B sin w t),  b = d / 2m + c / 2,  w^2 = k / m - b^2
  const double m = 0.5, k = 40.0, d = 0.3, c = 0.2, l0 = 0.4, v = 0.7;
  TestSim sim;
  sim.system.drag = c;
  const PointId nail = sim.nail(Vec3(0.0)), mass = sim.add({0.0, -l0, 0.0}, m, {0.0, v, 0.0});
  sim.join(nail, mass, k, l0, d);
  const auto exact = exact_of(sim);
  ASSERT_TRUE(exact);
  EXPECT_EQ(exact->name, "Exact solution");
  const double b = 0.5 * (d / m + c), w = std::sqrt(k / m - b * b), a = m * g / k;
  for (const double t : {0.3, 2.0}) {
    const double y = -l0 - a + std::exp(-b * t) * (a * std::cos(w * t) + (v + b * a) / w * std::sin(w * t));
    EXPECT_NEAR(after(*exact, sim.state, t).position[1].y, y, 1e-12);
  }
}

TEST(ExactMotion, OfTwoMassesIsTheirBeatAboutTheCenter) {
  const double m1 = 0.5, m2 = 2.0, k = 30.0, l0 = 1.0, stretch = 0.2, t = 1.7;
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const PointId first = sim.add(Vec3(0.0), m1), second = sim.add({l0 + stretch, 0.0, 0.0}, m2);
  sim.join(first, second, k, l0);
  const auto exact = exact_of(sim);
  ASSERT_TRUE(exact);
  const double omega = std::sqrt(k * (1.0 / m1 + 1.0 / m2));
  const State state = after(*exact, sim.state, t);
  EXPECT_NEAR(state.position[1].x - state.position[0].x, l0 + stretch * std::cos(omega * t), 1e-12);
  EXPECT_NEAR(m1 * state.position[0].x + m2 * state.position[1].x, m2 * (l0 + stretch), 1e-12);
}

TEST(ExactMotion, OfAModeOfAChain) {
  // omega_j = 2 sqrt(k / m) sin(j pi / (2 (n + 1)))
  constexpr int n = 9, j = 3;
  const double m = 0.2, k = 500.0, l0 = 0.1, amplitude = 0.01, t = 0.9;
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  PointId last = sim.nail(Vec3(0.0));
  for (int i = 1; i <= n + 1; ++i) {
    const Vec3 place(l0 * i, 0.0, 0.0);
    const PointId next = i == n + 1 ? sim.nail(place) : sim.add(place + Vec3(amplitude * std::sin(i * j * pi / (n + 1)), 0.0, 0.0), m);
    sim.join(last, next, k, l0);
    last = next;
  }
  const auto exact = exact_of(sim);
  ASSERT_TRUE(exact);
  const double omega = 2.0 * std::sqrt(k / m) * std::sin(j * pi / (2.0 * (n + 1)));
  const State state = after(*exact, sim.state, t);
  for (int i = 1; i <= n; ++i)
    EXPECT_NEAR(state.position[i].x - l0 * i, amplitude * std::sin(i * j * pi / (n + 1)) * std::cos(omega * t), 1e-12);
}

TEST(ExactMotion, OfAPendulumAtASmallAngleIsThatOfTheLinearEquation) {
  const double m = 1.0, k = 1e4, l0 = 0.5, angle = 0.02;
  TestSim sim;
  const double length = l0 + m * g / k;
  const PointId nail = sim.nail(Vec3(0.0)), mass = sim.add({length * std::sin(angle), -length * std::cos(angle), 0.0}, m);
  sim.join(nail, mass, k, l0);
  const auto exact = exact_of(sim);
  ASSERT_TRUE(exact);
  EXPECT_EQ(exact->name, "Small vibrations");
  const double omega = std::sqrt(g / length);
  for (const double t : {0.4, 3.1})
    EXPECT_NEAR(after(*exact, sim.state, t).position[1].x, length * std::sin(angle) * std::cos(omega * t), 1e-7);

  // the pendulum itself differs by the third order of the angle
  TestSim run = sim;
  run.run(*find_integrator("blanes_moan4"), 1.0, 4000);
  EXPECT_LT(std::abs(after(*exact, sim.state, 1.0).position[1].x - run.state.position[1].x), length * std::pow(angle, 3));

  // not a small angle
  sim.state.position[1] = {length * std::sin(1.0), -length * std::cos(1.0), 0.0};
  EXPECT_FALSE(exact_of(sim));
}

TEST(ExactMotion, OfAHangingRopeIsTheElasticCatenaryToWhichTheEquilibriumConverges) {
  const auto gap = [](int n) {
    TestSim sim;
    const double length = 1.3, mass = 0.4, stiffness = 60.0, l0 = length / n;
    PointId last = sim.nail(Vec3(0.0));
    for (int i = 1; i <= n; ++i) {
      const Vec3 place(0.9 * i / n, -0.2 * i / n, 0.0);
      const PointId next = i == n ? sim.nail(place) : sim.add(place, mass / n);
      sim.join(last, next, stiffness * n, l0);
      last = next;
    }
    const auto exact = exact_of(sim);
    if (!exact || exact->name != "Catenary at rest") return 1.0;
    State state = sim.state;
    exact->exact(state, 1.0);
    const Forecast forecast = make_forecast(std::make_shared<const System>(sim.system), sim.state, {}, false);
    return weighted_distance(sim.system, state.position, forecast.rest, 1.0).rms;
  };
  const double coarse = gap(12), fine = gap(24);
  EXPECT_LT(coarse, 2e-2);
  EXPECT_GT(coarse / fine, 3.5);
  EXPECT_LT(coarse / fine, 4.5);
}

TEST(ExactMotion, IsNotClaimedWhereThereIsNone) {
  TestSim sim;
  const PointId nail = sim.nail(Vec3(0.0)), mass = sim.add({0.0, -0.5, 0.0}, 1.0);
  sim.join(nail, mass, 100.0, 0.4);
  ASSERT_TRUE(exact_of(sim));
  TestSim held = sim;
  held.system.grab = Grab{.point = mass};
  EXPECT_FALSE(exact_of(held));
  TestSim limited = sim;
  limited.system.strain_limit = 0.1;
  EXPECT_FALSE(exact_of(limited));
  TestSim sideways = sim;
  sideways.state.velocity[1].x = 2.0;
  EXPECT_FALSE(exact_of(sideways));
  TestSim above_floor = sim;
  above_floor.system.colliders.push_back({.shape = Plane{{0.0, -5.0, 0.0}, {0.0, 1.0, 0.0}}});
  EXPECT_EQ(exact_of(above_floor)->name, "Exact solution without contact");
  EXPECT_FALSE(exact_of(net(6, 1e3, 0.0)));
}

TEST(ExactMotion, TheReferenceIsNearTheConvergedSolution) {
  const TestSim sim = net(5, 1e3, 0.0);
  const Companion reference = exact_or_reference(std::make_shared<const System>(sim.system), sim.state, {});
  EXPECT_TRUE(reference.name.starts_with("Reference (dop853, ")) << reference.name;
  TestSim run = sim, converged = sim;
  for (int frame = 0; frame < 30; ++frame) {
    run.run(*reference.settings.integrator, 1.0 / 60.0, reference.settings.substeps, *reference.settings.tolerance);
    converged.run(*find_integrator("blanes_moan4"), 1.0 / 60.0, 200);
  }
  EXPECT_LT(weighted_distance(run.system, run.state.position, converged.state.position, 1.0).rms, 1e-6);
}

TEST(ExactMotion, OfAPairThatRotatesOrPassesThroughZeroLengthIsNotClaimed) {
  const auto pair = [](const Vec3& velocity) {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    const PointId first = sim.add(Vec3(0.0), 1.0, -velocity), second = sim.add({1.0, 0.0, 0.0}, 1.0, velocity);
    sim.join(first, second, 50.0, 1.0);
    return sim;
  };
  EXPECT_TRUE(exact_of(pair({0.1, 0.0, 0.0})));
  EXPECT_FALSE(exact_of(pair({0.0, 0.1, 0.0})));
  EXPECT_FALSE(exact_of(pair({6.0, 0.0, 0.0})));
  // moving together across their line
  TestSim sim = pair(Vec3(0.0));
  sim.state.velocity.assign(2, Vec3(0.0, 0.2, 0.0));
  EXPECT_TRUE(exact_of(sim));
  // about a nail
  TestSim pendulum;
  pendulum.system.gravity = Vec3(0.0);
  pendulum.join(pendulum.nail(Vec3(0.0)), pendulum.add({1.0, 0.0, 0.0}, 1.0, {0.0, 0.1, 0.0}), 50.0, 1.0);
  EXPECT_FALSE(exact_of(pendulum));
}

TEST(ExactMotion, SaysThatItIgnoresContactBetweenPoints) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.system.contact.points = true;
  sim.join(sim.add(Vec3(0.0)), sim.add({1.0, 0.0, 0.0}), 50.0, 0.9);
  const auto exact = exact_of(sim);
  ASSERT_TRUE(exact);
  EXPECT_EQ(exact->name, "Exact solution without contact");
}

}  // namespace
}  // namespace hooke
