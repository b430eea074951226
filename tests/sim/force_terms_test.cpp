// The listed forces against their formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/force_terms.h"
#include "sim/forces/forces.h"
#include "sim/forces/terms/rows.h"
#include "sim/methods/rows.h"
#include "sim/step/divergence.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

Force force(std::string_view id, std::initializer_list<double> values) {
  Force result{.term = find_force_term(id)};
  std::copy(values.begin(), values.end(), result.values.begin());
  return result;
}

// The sum of the listed forces on each point.
std::vector<Vec3> listed_forces(const TestSim& sim, double time = 0.0) {
  const Plan plan = make_plan(sim.system);
  Motion motion;
  pack(plan, sim.state, motion);
  Field f(motion.x.size(), 0.0);
  add_force_terms(plan, time, motion.x, motion.v, f);
  std::vector<Vec3> result;
  for (Index i = 0; i < plan.points; ++i) result.emplace_back(f[i], f[plan.points + i], f[2 * plan.points + i]);
  return result;
}

TEST(ForceTerms, AreTheConstantsOfTheirFiles) {
  EXPECT_EQ(&wind_force, find_force_term("wind"));
  EXPECT_EQ(&sticky_force, &force_terms()[force_terms().size() - 1]);
}

TEST(ForceTerms, AreUniqueAndHaveLabelsRangesAndDefaults) {
  for (const ForceTerm& term : force_terms()) {
    EXPECT_EQ(find_force_term(term.id), &term);
    EXPECT_FALSE(term.label.empty());
    EXPECT_FALSE(term.description.empty());
    EXPECT_LE(term.numbers.size(), max_force_parameters);
    for (const ForceParameter& number : term.numbers) {
      EXPECT_LT(number.min, number.max) << number.name;
      EXPECT_GE(number.default_value, number.min) << number.name;
      EXPECT_LE(number.default_value, number.max) << number.name;
    }
  }
}

TEST(ForceTerms, DoNothingWhenOff) {
  TestSim sim;
  sim.add({1.0, 0.0, 0.0});
  for (const ForceTerm& term : force_terms()) sim.system.forces.push_back({.term = &term, .on = false, .values = default_values(term)});
  EXPECT_TRUE(make_plan(sim.system).forces.empty());
}

TEST(ForceTerms, NeutralBuoyancyKeepsAPointFloating) {
  TestSim sim;
  const PointId point = sim.add({0.0, 0.0, 0.0}, 2.0);
  sim.system.forces = {force("buoyancy", {1.0})};
  sim.run(*find_integrator("velocity_verlet"), 1.0, 100);
  EXPECT_NEAR(glm::length(sim.position(point)), 0.0, 1e-12);
}

TEST(ForceTerms, ACenterOfPowerTwoKeepsACircularOrbit) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const double r = 2.0, strength = 3.0, speed = std::sqrt(strength / r);  // v^2 / r = s / r^2
  const PointId point = sim.add({r, 0.0, 0.0}, 5.0, {0.0, speed, 0.0});
  sim.system.forces = {force("center", {0.0, 0.0, 0.0, strength, 2.0, 0.01})};
  const double period = 2.0 * 3.14159265358979323846 * r / speed;
  sim.run(*find_integrator("runge_kutta4"), period, 1000);
  EXPECT_NEAR(glm::distance(sim.position(point), Vec3(r, 0.0, 0.0)), 0.0, 1e-8);
}

TEST(ForceTerms, ThePullOnTheCenterOfMassIsADampedOscillatorOfTheWhole) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const PointId first = sim.add({1.0, 0.0, 0.0}, 1.0), second = sim.add({2.0, 0.0, 0.0}, 3.0);
  sim.join(first, second, 100.0, 1.0);
  sim.system.forces = {force("mass_center", {0.0, 0.0, 0.0, 16.0, 0.0})};
  const double omega = std::sqrt(16.0 / 4.0), center = 1.75;
  sim.run(*find_integrator("runge_kutta4"), 1.0, 1000);
  const double moved = (sim.position(first).x + 3.0 * sim.position(second).x) / 4.0;
  EXPECT_NEAR(moved, center * std::cos(omega), 1e-9);
}

TEST(ForceTerms, AWallRepelsByAPowerOfTheDistance) {
  TestSim sim;
  sim.add({0.0, 0.5, 0.0}, 2.0);
  sim.system.colliders = {{.shape = Plane{}}};
  sim.system.forces = {force("wall", {3.0, 2.0, 0.01})};
  EXPECT_NEAR(listed_forces(sim)[0].y, 2.0 * 3.0 / 0.25, 1e-12);
}

TEST(ForceTerms, AStickyCeilingHoldsUpToItsStrength) {
  for (const double strength : {10.0, 9.0}) {
    TestSim sim;  // 1 kg weighs 9.81 N
    const PointId point = sim.add({0.0, 0.0, 0.0}, 1.0);
    sim.system.colliders = {{.shape = Plane{.normal = {0.0, -1.0, 0.0}}}};
    sim.system.forces = {force("sticky", {strength})};
    sim.run(*find_integrator("velocity_verlet"), 1.0, 100);
    if (strength > 9.81)
      EXPECT_NEAR(sim.position(point).y, 0.0, 1e-12);
    else
      EXPECT_NEAR(sim.position(point).y, -0.5 * 9.81, 1e-9);
  }
}

// A triangle of area 1/2 in the plane z = 0.
TestSim triangle() {
  TestSim sim;
  const PointId a = sim.add({0.0, 0.0, 0.0}), b = sim.add({1.0, 0.0, 0.0}), c = sim.add({0.0, 1.0, 0.0});
  sim.system.faces.push_back({{a, b, c}});
  return sim;
}

TEST(ForceTerms, WindPushesAcrossAndAlongFaces) {
  TestSim sim = triangle();
  sim.system.forces = {force("wind", {0.0, 0.0, 4.0, 0.6, 0.1, 0.0, 1.0, 1.0})};
  for (const Vec3& f : listed_forces(sim)) EXPECT_NEAR(glm::distance(f, Vec3(0.0, 0.0, 0.5 * 0.6 * 16.0 / 3.0)), 0.0, 1e-12);
  sim.system.forces = {force("wind", {4.0, 0.0, 0.0, 0.6, 0.1, 0.0, 1.0, 1.0})};
  for (const Vec3& f : listed_forces(sim)) EXPECT_NEAR(glm::distance(f, Vec3(0.5 * 0.1 * 16.0 / 3.0, 0.0, 0.0)), 0.0, 1e-12);
}

TEST(ForceTerms, WindExertsNoForceOnPointsThatMoveWithIt) {
  TestSim sim = triangle();
  for (Vec3& v : sim.state.velocity) v = {1.0, 2.0, 3.0};
  sim.system.forces = {force("wind", {1.0, 2.0, 3.0, 0.6, 0.1, 0.0, 1.0, 1.0})};
  for (const Vec3& f : listed_forces(sim)) EXPECT_EQ(f, Vec3(0.0));
}

TEST(ForceTerms, GustsAreSmoothBoundedAndReproducibleFromTheirSeed) {
  TestSim sim = triangle();
  sim.system.forces = {force("wind", {0.0, 0.0, 4.0, 0.6, 0.0, 0.5, 1.0, 7.0})};
  const double mean_force = 0.5 * 0.6 * 16.0 / 3.0;
  double min = 1e9, max = -1e9, last = listed_forces(sim, 0.0)[0].z;
  for (double t = 0.0; t < 200.0; t += 0.01) {
    const double f = listed_forces(sim, t)[0].z;
    min = std::min(min, f);
    max = std::max(max, f);
    EXPECT_LT(std::abs(f - last), 0.1 * mean_force);
    last = f;
  }
  EXPECT_GE(min, 0.25 * mean_force - 1e-12);
  EXPECT_LE(max, 2.25 * mean_force + 1e-12);
  EXPECT_GT(max - min, 0.5 * mean_force);

  const double before = listed_forces(sim, 3.3)[0].z;
  EXPECT_EQ(listed_forces(sim, 3.3)[0].z, before);
  sim.system.forces[0].values[7] = 8.0;
  EXPECT_NE(listed_forces(sim, 3.3)[0].z, before);
}

TEST(ForceTerms, ActInEveryMethod) {
  for (const Integrator& method : integrators()) {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    const PointId point = sim.add({0.5, 0.0, 0.0}, 1.0);
    sim.system.forces = {force("center", {0.0, 0.0, 0.0, 1.0, -1.0, 0.01})};  // a = -x
    sim.run(method, 1.0, 2000);
    EXPECT_NEAR(sim.position(point).x, 0.5 * std::cos(1.0), 1e-3) << method.id;
  }
}

TEST(ForceTerms, WorkIsRecordedInTheLedger) {
  // a point pulled from rest towards a center gains far more than M g L, which is not a divergence
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.add({1.0, 0.0, 0.0}, 1.0);
  sim.system.forces = {force("center", {0.0, 0.0, 0.0, 1000.0, 2.0, 0.01})};
  initialize_supply(sim.system, sim.state);
  sim.run(velocity_verlet, 1.0 / 30.0, 4000);
  const double kinetic = compute_energy(sim.system, sim.state).kinetic;
  ASSERT_GT(kinetic, 100.0);
  EXPECT_NEAR(sim.state.supply.net_input, kinetic, 1e-5 * kinetic);
}

// Forces that are smooth over a step of 1/60 s.
std::vector<Force> smooth_forces() {
  return {force("buoyancy", {0.7}), force("center", {0.0, 0.0, 0.0, 4.0, 1.0, 0.5}), force("mass_center", {0.2, 0.0, 0.0, 10.0, 2.0}),
          force("wall", {2.0, 1.0, 0.1}), force("wind", {2.0, 0.0, 1.0, 0.6, 0.1, 0.0, 1.0, 1.0})};
}

// one step per frame, as an adaptive method takes it
TEST(ForceTerms, TheWorkOfEachAccountsForTheEnergyOfAnExactRun) {
  for (const Force& each : smooth_forces()) {
    TestSim sim = triangle();
    const auto id = [&](Index i) { return sim.system.points()[i].id; };
    for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {2, 0}}) sim.join(id(i), id(j), 50.0, 1.0);
    for (Vec3& v : sim.state.velocity) v = {0.5, 2.0, -1.0};
    for (Index i = 0; i < 3; ++i) sim.system.point(i).radius = 0.1;
    sim.system.colliders = {{.shape = Plane{.point = {0.0, -3.0, 0.0}}}};
    sim.system.forces = {each};
    initialize_supply(sim.system, sim.state);
    double supplied = 0.0;
    for (int frame = 0; frame < 30; ++frame) {
      const double before = sim.state.supply.net_input;
      sim.run(dop853, 1.0 / 60.0, 1, 1e-12);
      supplied += std::abs(sim.state.supply.net_input - before);
    }
    ASSERT_GT(supplied, 0.1) << each.term->id;
    EXPECT_NEAR(compute_energy(sim.system, sim.state).total(), sim.state.supply.net_input, 1e-4 * supplied) << each.term->id;
  }
}

TEST(ForceTerms, ThePullTowardsACenterIsContinuousWithContinuousSlope) {
  for (const double power : {-3.0, -1.0, 0.0, 1.0, 2.0, 3.7}) {
    const double core = 0.1;
    const auto pull_at = [&](double r) {
      TestSim sim;
      sim.add({r, 0.0, 0.0}, 1.0);
      sim.system.forces = {force("center", {0.0, 0.0, 0.0, 1.0, power, core})};
      return -listed_forces(sim)[0].x;
    };
    const double h = 1e-7, at_core = std::pow(core, -power);
    EXPECT_NEAR(pull_at(core * (1.0 - 1e-12)), at_core, 1e-9 * at_core) << power;
    EXPECT_NEAR((pull_at(core) - pull_at(core - h)) / h, -power * at_core / core, 1e-4 * at_core / core) << power;
    EXPECT_EQ(pull_at(0.0), 0.0) << power;
    EXPECT_NEAR(pull_at(1e-9), -pull_at(-1e-9), 1e-12 * at_core) << power;
    EXPECT_NEAR(pull_at(2.0), std::pow(2.0, -power), 1e-12) << power;
  }
}

// A point under an inverse-square law that falls through the center and returns.
TEST(ForceTerms, AFallThroughTheCenterConservesEnergy) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const PointId point = sim.add({1.0, 0.0, 0.0});
  sim.system.forces = {force("center", {0.0, 0.0, 0.0, 1.0, 2.0, 0.05})};
  double max = 0.0;
  for (int frame = 0; frame < 460; ++frame) {
    sim.run(velocity_verlet, 0.01, 200);
    max = frame > 400 ? std::max(max, std::abs(sim.position(point).x)) : max;
  }
  EXPECT_NEAR(max, 1.0, 1e-3);
}

}  // namespace
}  // namespace hooke
