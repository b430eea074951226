// The listed forces against their formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/divergence.h"
#include "sim/forces/force_term.h"
#include "sim/forces/forces.h"
#include "sim/forces/terms/rows.h"
#include "sim/integrators/rows.h"
#include "support/trial.h"

namespace hooke {
namespace {

Force force(std::string_view id, std::initializer_list<double> values) {
  Force result{.term = find_force_term(id)};
  std::copy(values.begin(), values.end(), result.values.begin());
  return result;
}

// The sum of the listed forces on each point.
std::vector<Vec3> listed_forces(const Trial& trial, double time = 0.0) {
  const Plan plan = make_plan(trial.system);
  Motion motion;
  pack(plan, trial.state, motion);
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
  Trial trial;
  trial.add({1.0, 0.0, 0.0});
  for (const ForceTerm& term : force_terms()) trial.system.forces.push_back({.term = &term, .on = false, .values = default_values(term)});
  EXPECT_TRUE(make_plan(trial.system).forces.empty());
}

TEST(ForceTerms, NeutralBuoyancyKeepsAPointFloating) {
  Trial trial;
  const PointId point = trial.add({0.0, 0.0, 0.0}, 2.0);
  trial.system.forces = {force("buoyancy", {1.0})};
  trial.run(*find_integrator("velocity_verlet"), 1.0, 100);
  EXPECT_NEAR(glm::length(trial.position(point)), 0.0, 1e-12);
}

TEST(ForceTerms, ACenterOfPowerTwoKeepsACircularOrbit) {
  Trial trial;
  trial.system.gravity = Vec3(0.0);
  const double r = 2.0, strength = 3.0, speed = std::sqrt(strength / r);  // v^2 / r = s / r^2
  const PointId point = trial.add({r, 0.0, 0.0}, 5.0, {0.0, speed, 0.0});
  trial.system.forces = {force("center", {0.0, 0.0, 0.0, strength, 2.0, 0.01})};
  const double period = 2.0 * 3.14159265358979323846 * r / speed;
  trial.run(*find_integrator("runge_kutta4"), period, 1000);
  EXPECT_NEAR(glm::distance(trial.position(point), Vec3(r, 0.0, 0.0)), 0.0, 1e-8);
}

TEST(ForceTerms, ThePullOnTheCenterOfMassIsADampedOscillatorOfTheWhole) {
  Trial trial;
  trial.system.gravity = Vec3(0.0);
  const PointId first = trial.add({1.0, 0.0, 0.0}, 1.0), second = trial.add({2.0, 0.0, 0.0}, 3.0);
  trial.join(first, second, 100.0, 1.0);
  trial.system.forces = {force("mass_center", {0.0, 0.0, 0.0, 16.0, 0.0})};
  const double omega = std::sqrt(16.0 / 4.0), center = 1.75;
  trial.run(*find_integrator("runge_kutta4"), 1.0, 1000);
  const double moved = (trial.position(first).x + 3.0 * trial.position(second).x) / 4.0;
  EXPECT_NEAR(moved, center * std::cos(omega), 1e-9);
}

TEST(ForceTerms, AWallRepelsByAPowerOfTheDistance) {
  Trial trial;
  trial.add({0.0, 0.5, 0.0}, 2.0);
  trial.system.colliders = {{.shape = Plane{}}};
  trial.system.forces = {force("wall", {3.0, 2.0, 0.01})};
  EXPECT_NEAR(listed_forces(trial)[0].y, 2.0 * 3.0 / 0.25, 1e-12);
}

TEST(ForceTerms, AStickyCeilingHoldsUpToItsStrength) {
  for (const double strength : {10.0, 9.0}) {
    Trial trial;  // 1 kg weighs 9.81 N
    const PointId point = trial.add({0.0, 0.0, 0.0}, 1.0);
    trial.system.colliders = {{.shape = Plane{.normal = {0.0, -1.0, 0.0}}}};
    trial.system.forces = {force("sticky", {strength})};
    trial.run(*find_integrator("velocity_verlet"), 1.0, 100);
    if (strength > 9.81)
      EXPECT_NEAR(trial.position(point).y, 0.0, 1e-12);
    else
      EXPECT_NEAR(trial.position(point).y, -0.5 * 9.81, 1e-9);
  }
}

// A triangle of area 1/2 in the plane z = 0.
Trial triangle() {
  Trial trial;
  const PointId a = trial.add({0.0, 0.0, 0.0}), b = trial.add({1.0, 0.0, 0.0}), c = trial.add({0.0, 1.0, 0.0});
  trial.system.faces.push_back({{a, b, c}});
  return trial;
}

TEST(ForceTerms, WindPushesAcrossAndAlongFaces) {
  Trial trial = triangle();
  trial.system.forces = {force("wind", {0.0, 0.0, 4.0, 0.6, 0.1, 0.0, 1.0, 1.0})};
  for (const Vec3& f : listed_forces(trial)) EXPECT_NEAR(glm::distance(f, Vec3(0.0, 0.0, 0.5 * 0.6 * 16.0 / 3.0)), 0.0, 1e-12);
  trial.system.forces = {force("wind", {4.0, 0.0, 0.0, 0.6, 0.1, 0.0, 1.0, 1.0})};
  for (const Vec3& f : listed_forces(trial)) EXPECT_NEAR(glm::distance(f, Vec3(0.5 * 0.1 * 16.0 / 3.0, 0.0, 0.0)), 0.0, 1e-12);
}

TEST(ForceTerms, WindExertsNoForceOnPointsThatMoveWithIt) {
  Trial trial = triangle();
  for (Vec3& v : trial.state.velocity) v = {1.0, 2.0, 3.0};
  trial.system.forces = {force("wind", {1.0, 2.0, 3.0, 0.6, 0.1, 0.0, 1.0, 1.0})};
  for (const Vec3& f : listed_forces(trial)) EXPECT_EQ(f, Vec3(0.0));
}

TEST(ForceTerms, GustsAreSmoothBoundedAndReproducibleFromTheirSeed) {
  Trial trial = triangle();
  trial.system.forces = {force("wind", {0.0, 0.0, 4.0, 0.6, 0.0, 0.5, 1.0, 7.0})};
  const double mean_force = 0.5 * 0.6 * 16.0 / 3.0;
  double min = 1e9, max = -1e9, last = listed_forces(trial, 0.0)[0].z;
  for (double t = 0.0; t < 200.0; t += 0.01) {
    const double f = listed_forces(trial, t)[0].z;
    min = std::min(min, f);
    max = std::max(max, f);
    EXPECT_LT(std::abs(f - last), 0.1 * mean_force);
    last = f;
  }
  EXPECT_GE(min, 0.25 * mean_force - 1e-12);
  EXPECT_LE(max, 2.25 * mean_force + 1e-12);
  EXPECT_GT(max - min, 0.5 * mean_force);

  const double before = listed_forces(trial, 3.3)[0].z;
  EXPECT_EQ(listed_forces(trial, 3.3)[0].z, before);
  trial.system.forces[0].values[7] = 8.0;
  EXPECT_NE(listed_forces(trial, 3.3)[0].z, before);
}

TEST(ForceTerms, ActInEveryMethod) {
  for (const Integrator& method : integrators()) {
    Trial trial;
    trial.system.gravity = Vec3(0.0);
    const PointId point = trial.add({0.5, 0.0, 0.0}, 1.0);
    trial.system.forces = {force("center", {0.0, 0.0, 0.0, 1.0, -1.0, 0.01})};  // a = -x
    trial.run(method, 1.0, 2000);
    EXPECT_NEAR(trial.position(point).x, 0.5 * std::cos(1.0), 1e-3) << method.id;
  }
}

TEST(ForceTerms, WorkIsRecordedInTheLedger) {
  // a point pulled from rest towards a center gains far more than M g L, which is not a divergence
  Trial trial;
  trial.system.gravity = Vec3(0.0);
  trial.add({1.0, 0.0, 0.0}, 1.0);
  trial.system.forces = {force("center", {0.0, 0.0, 0.0, 1000.0, 2.0, 0.01})};
  initialize_ledger(trial.system, trial.state);
  trial.run(velocity_verlet, 1.0 / 30.0, 4000);
  const double kinetic = compute_energy(trial.system, trial.state).kinetic;
  ASSERT_GT(kinetic, 100.0);
  EXPECT_NEAR(trial.state.ledger.net_input, kinetic, 1e-5 * kinetic);
}

// Forces that are smooth over a step of 1/60 s.
std::vector<Force> smooth_forces() {
  return {force("buoyancy", {0.7}), force("center", {0.0, 0.0, 0.0, 4.0, 1.0, 0.5}), force("mass_center", {0.2, 0.0, 0.0, 10.0, 2.0}),
          force("wall", {2.0, 1.0, 0.1}), force("wind", {2.0, 0.0, 1.0, 0.6, 0.1, 0.0, 1.0, 1.0})};
}

// one step per frame, as an adaptive method takes it
TEST(ForceTerms, TheWorkOfEachAccountsForTheEnergyOfAnExactRun) {
  for (const Force& each : smooth_forces()) {
    Trial trial = triangle();
    const auto id = [&](Index i) { return trial.system.points()[i].id; };
    for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {2, 0}}) trial.join(id(i), id(j), 50.0, 1.0);
    for (Vec3& v : trial.state.velocity) v = {0.5, 2.0, -1.0};
    for (Index i = 0; i < 3; ++i) trial.system.point(i).radius = 0.1;
    trial.system.colliders = {{.shape = Plane{.point = {0.0, -3.0, 0.0}}}};
    trial.system.forces = {each};
    initialize_ledger(trial.system, trial.state);
    double supplied = 0.0;
    for (int frame = 0; frame < 30; ++frame) {
      const double before = trial.state.ledger.net_input;
      trial.run(dop853, 1.0 / 60.0, 1, 1e-12);
      supplied += std::abs(trial.state.ledger.net_input - before);
    }
    ASSERT_GT(supplied, 0.1) << each.term->id;
    EXPECT_NEAR(compute_energy(trial.system, trial.state).total(), trial.state.ledger.net_input, 1e-4 * supplied) << each.term->id;
  }
}

TEST(ForceTerms, ThePullTowardsACenterIsContinuousWithContinuousSlope) {
  for (const double power : {-3.0, -1.0, 0.0, 1.0, 2.0, 3.7}) {
    const double core = 0.1;
    const auto pull_at = [&](double r) {
      Trial trial;
      trial.add({r, 0.0, 0.0}, 1.0);
      trial.system.forces = {force("center", {0.0, 0.0, 0.0, 1.0, power, core})};
      return -listed_forces(trial)[0].x;
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
  Trial trial;
  trial.system.gravity = Vec3(0.0);
  const PointId point = trial.add({1.0, 0.0, 0.0});
  trial.system.forces = {force("center", {0.0, 0.0, 0.0, 1.0, 2.0, 0.05})};
  double max = 0.0;
  for (int frame = 0; frame < 460; ++frame) {
    trial.run(velocity_verlet, 0.01, 200);
    max = frame > 400 ? std::max(max, std::abs(trial.position(point).x)) : max;
  }
  EXPECT_NEAR(max, 1.0, 1e-3);
}

}  // namespace
}  // namespace hooke
