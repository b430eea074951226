// Steps that are too long for the listed forces are warned about before the run.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/step_advice.h"
#include "sim/model/force_term.h"
#include "sim/step/divergence.h"
#include "study/hard_cases/monitored_run.h"
#include "support/force_with.h"

namespace hooke {
namespace {

// 5 x 5 points at rest, 1 m, each of `mass` [kg], with faces.
TestNetwork sheet_with_faces(double mass, double stiffness) {
  TestNetwork sheet = make_sheet({.rows = 5,
                                  .columns = 5,
                                  .across = {0.25, 0.0, 0.0},
                                  .down = {0.0, 0.0, 0.25},
                                  .mass = mass,
                                  .stiffness = stiffness,
                                  .diagonal_stiffness = stiffness});
  const auto id = [&](int row, int column) { return sheet.system.points()[row * 5 + column].id; };
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      sheet.system.faces.push_back({.points = {id(row, column), id(row, column + 1), id(row + 1, column)}});
      sheet.system.faces.push_back({.points = {id(row, column + 1), id(row + 1, column + 1), id(row + 1, column)}});
    }
  return sheet;
}

struct Outcome {
  bool failed;  // diverged, or gained more than a tenth of the energy supplied
  bool warned;  // before
};

Outcome outcome_of(TestNetwork network, const Settings& settings) {
  initialize_supply(network.system, network.state);
  MonitoredRun run(network, settings);
  run.run(0.2);
  return {run.stopped() || run.monitor().energy_rise() > 0.1, step_warning(network.system, network.state, settings).has_value()};
}

std::vector<const Integrator*> implicit_methods() {
  std::vector<const Integrator*> methods;
  for (const Integrator& method : integrators())
    if (method.is_implicit()) methods.push_back(&method);
  return methods;
}

TEST(StepWarning, PrecedesEveryFailureOfAnImplicitMethodInWind) {
  int failed = 0, quiet = 0;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    Random random(seed);
    TestNetwork sheet = sheet_with_faces(std::pow(10.0, random.uniform(-4.0, 0.0)), std::pow(10.0, random.uniform(0.0, 2.0)));
    if (seed % 2 == 0) sheet.system.point(0).nailed = sheet.system.point(4).nailed = true;
    TestNetwork calm = sheet;
    const double strength = std::pow(10.0, random.uniform(-4.0, 0.0));
    sheet.system.forces = {force_with("wind", {{"x", random.uniform(-50.0, 50.0)},
                                               {"y", random.uniform(-50.0, 50.0)},
                                               {"z", random.uniform(-50.0, 50.0)},
                                               {"normal", 5.0 * strength},
                                               {"tangential", strength},
                                               {"gusts", random.uniform(0.0, 1.0)}})};
    for (const Integrator* method : implicit_methods()) {
      const Settings settings{.integrator = method, .frame_rate = seed % 3 == 0 ? 15.0 : 60.0, .substeps = 1};
      // springs alone may be too stiff for a method that damps nothing
      if (outcome_of(calm, settings).failed) continue;
      const Outcome outcome = outcome_of(sheet, settings);
      EXPECT_TRUE(!outcome.failed || outcome.warned) << "scene " << seed << ", " << method->id;
      failed += outcome.failed ? 1 : 0;
      quiet += outcome.warned ? 0 : 1;
    }
  }
  EXPECT_GT(failed, 5);
  EXPECT_GT(quiet, 10);
}

// A moderate wind needs no warning.
TEST(StepWarning, IsAbsentInAWindThatIsSlowForTheStep) {
  TestNetwork sheet = sheet_with_faces(0.05, 50.0);
  sheet.system.forces = {force_with("wind", {{"x", 3.0}})};
  for (const Integrator* method : implicit_methods())
    EXPECT_FALSE(step_warning(sheet.system, sheet.state, {.integrator = method, .substeps = 1})) << method->id;
}

// The maximum of what implicit methods leave out: attractions that fall with the distance, and repulsions.
TEST(StepWarning, CountsTheForcesThatImplicitMethodsLeaveOut) {
  TestNetwork network;
  network.add(Vec3(0.1));
  network.system.colliders = {{.shape = Plane{.point = {0.0, -1.0, 0.0}}}};
  const auto omitted = [&](const Force& force) {
    network.system.forces = {force};
    const double omega = bound_spectrum(network.system).omitted_omega;
    return omega * omega;
  };
  EXPECT_EQ(omitted(force_with("center", {{"strength", 100.0}, {"power", -1.0}})), 0.0);
  EXPECT_NEAR(omitted(force_with("center", {{"strength", 100.0}, {"power", 2.0}, {"core", 1.0}})), 200.0, 1e-10);
  EXPECT_NEAR(omitted(force_with("center", {{"strength", -100.0}, {"power", -1.0}})), 100.0, 1e-10);
  EXPECT_NEAR(omitted(force_with("center", {{"strength", -100.0}, {"power", -3.0}})), 300.0, 1e-10);
  EXPECT_EQ(omitted(force_with("wall", {{"strength", 100.0}})), 0.0);
  EXPECT_NEAR(omitted(force_with("wall", {{"strength", -100.0}, {"power", 1.0}, {"core", 1.0}})), 100.0, 1e-10);

  // the step that a method with an implicit system may take
  network.system.colliders.clear();
  network.system.forces = {force_with("center", {{"strength", -100.0}, {"power", -1.0}})};
  EXPECT_NEAR(largest_stable_step(*find_integrator("implicit_euler"), bound_spectrum(network.system)), 0.1, 1e-12);
}

// Only a method that adapts its steps is left, which is not tested.
TEST(StepWarning, OfTheStiffMethodSaysOnceThatNoStepIsShortEnough) {
  TestNetwork network;
  network.add(Vec3(10.0, 0.0, 0.0));
  network.system.gravity = Vec3(0.0);
  network.system.forces = {force_with("center", {{"strength", 1.0}, {"power", 2.0}, {"core", 1e-6}})};
  EXPECT_EQ(step_warning(network.system, network.state, {.integrator = &stiff_integrator(), .substeps = 20}),
            "simulation.integrator: tr_bdf2: needs more than 1,000,000 substeps per frame here");
}

// Light points that reach the speed of the wind within a fraction of the step: the work of the wind is not a gain of energy.
TEST(StepWarning, IsNotNeededForLightPointsThatTheWindCarriesAway) {
  TestNetwork network;
  network.join(network.add(Vec3(0.0), 2e-4), network.add({0.3, 0.0, 0.0}, 2e-4), 10.0);
  for (Index i = 0; i < 2; ++i) network.system.point(i).radius = 0.02;
  network.system.forces = {force_with("wind", {{"x", 35.0}, {"z", -22.0}, {"normal", 4.5}, {"gusts", 0.0}})};
  for (const char* id : {"implicit_euler", "baraff_witkin"})
    EXPECT_FALSE(outcome_of(network, {.integrator = find_integrator(id), .substeps = 1}).failed) << id;
}

// The wind moves past a fast point as it would past one at rest.
TEST(StepWarning, CountsTheSpeedOfThePointsInStillAir) {
  const auto warning_at = [](double speed) {
    TestNetwork network;
    network.system.gravity = Vec3(0.0);
    const PointId point = network.add(Vec3(0.0), 1e-3, {speed, 0.0, 0.0});
    network.system.point(network.index(point)).radius = 0.5;
    network.system.forces = {force_with("wind", {{"x", 0.0}, {"z", 0.0}})};
    return step_warning(network.system, network.state, {.integrator = find_integrator("velocity_verlet"), .substeps = 5}).value_or("");
  };
  EXPECT_EQ(warning_at(0.0), "");
  EXPECT_NE(warning_at(1000.0).find("its linear stability limit is"), std::string::npos) << warning_at(1000.0);
}

TEST(StepWarning, OfContactDoesNotSpeakOfALinearLimit) {
  TestNetwork network;
  network.join(network.add(Vec3(0.0), 1e-3), network.add({0.3, 0.0, 0.0}, 1e-3), 1e4);
  for (Index i = 0; i < 2; ++i) network.system.point(i).radius = 0.02;
  for (const char* id : {"implicit_euler", "dop853"}) {
    const Settings settings{.integrator = find_integrator(id), .substeps = 20};
    network.system.contact.points = false;
    EXPECT_EQ(step_warning(network.system, network.state, settings), std::nullopt) << id;
    network.system.contact.points = true;
    const std::string warning = step_warning(network.system, network.state, settings).value_or("");
    EXPECT_NE(warning.find("contact may cause growth with fewer than"), std::string::npos) << warning;
    EXPECT_EQ(warning.find("linear"), std::string::npos) << warning;
  }
}

}  // namespace
}  // namespace hooke
