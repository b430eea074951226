// Warnings about the accumulated error of a run.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lab/accuracy/accuracy_text.h"
#include "sim/control/automatic.h"
#include "support/convergence.h"
#include "support/measured_lab.h"

namespace hooke {
namespace {

// A mass that vibrates at 10 rad/s with an amplitude of 0.5 m, and another nail.
TestSim vibration() {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const PointId nail = sim.nail(Vec3(0.0));
  sim.join(nail, sim.add(Vec3(1.5, 0.0, 0.0), 1.0), 100.0, 1.0);
  return sim;
}

Lab run(const TestSim& sim, const Settings& settings, int frames) {
  Lab lab = measured_lab(scene_of(sim, settings));
  for (int frame = 0; frame < frames; ++frame) EXPECT_TRUE(lab.step());
  return lab;
}

std::string warning_of(const Lab& lab) { return accumulated_warning(lab.accuracy()).value_or(""); }

TEST(AccumulatedWarning, IsAccompaniedByAToleranceThatKeepsTheErrorSmall) {
  const Lab wrong = run(vibration(), {.integrator = find_integrator("implicit_euler"), .substeps = 1, .tolerance = {}}, 25);
  const std::string warning = warning_of(wrong);
  EXPECT_TRUE(warning.starts_with("accumulated error of about ")) << warning;
  EXPECT_TRUE(warning.ends_with(" % of the motion")) << warning;
  EXPECT_EQ(tolerance_to_try(wrong.accuracy(), wrong.scene().settings), 0.02);

  const Lab recommended = run(vibration(), {.integrator = &automatic_method(), .tolerance = 0.02}, 25);
  EXPECT_EQ(warning_of(recommended), "");
  const State& state = recommended.scene().state;
  EXPECT_NEAR(state.position[1].x, 1.0 + 0.5 * std::cos(10.0 * state.time), 0.01);
}

TEST(AccumulatedWarning, IsNotGivenForCorrectRuns) {
  for (const char* id : {"velocity_verlet", "runge_kutta4", "dop853", "implicit_midpoint", "tr_bdf2", "esdirk4"})
    EXPECT_EQ(warning_of(run(vibration(), {.integrator = find_integrator(id), .substeps = 20, .tolerance = {}}, 50)), "") << id;
  // rest, up to rounding errors
  TestSim rest;
  rest.system.gravity = Vec3(0.0);
  rest.join(rest.nail(Vec3(0.0)), rest.add(Vec3(1.0 + 1e-12, 0.0, 0.0), 1.0), 1e6, 1.0);
  EXPECT_EQ(warning_of(run(rest, {.integrator = find_integrator("implicit_euler"), .substeps = 1, .tolerance = {}}, 50)), "");
}

TEST(AccumulatedWarning, OfAutoIsAccompaniedByASmallerTolerance) {
  Accuracy accuracy{.is_on = true, .size = 1.0};
  accuracy.motion = 0.5;
  accuracy.accumulated.value = 0.3;
  accuracy.accumulated_time = 10.0;
  EXPECT_EQ(accumulated_warning(accuracy), "accumulated error of about 300 mm, 60 % of the motion");
  const auto tolerance_beside = [&](double present) {
    return tolerance_to_try(accuracy, {.integrator = &automatic_method(), .tolerance = present}).value_or(0.0);
  };
  EXPECT_DOUBLE_EQ(tolerance_beside(0.1), 5e-4);
  EXPECT_DOUBLE_EQ(tolerance_beside(1e-3), 1e-4);
}

// A tolerance hardly applies to contact, and a fast hand makes the steps of one short without end.
TEST(AccumulatedWarning, NamesNoToleranceBesideContactAndTheHand) {
  Accuracy accuracy{.is_on = true, .size = 1.0};
  accuracy.motion = 0.5;
  accuracy.accumulated.value = 0.3;
  accuracy.is_smooth = false;
  accuracy.half_error.reason = "not measured yet";
  EXPECT_EQ(accumulated_warning(accuracy),
            "accumulated error of about 300 mm, 60 % of the motion: no setting with a smaller error is known, because of contact, a strain "
            "limit or the hand");
  EXPECT_FALSE(tolerance_to_try(accuracy, {}));

  TestSim sim = vibration();
  sim.system.contact.points = true;
  const Lab lab = run(sim, {.integrator = find_integrator("implicit_euler"), .substeps = 1, .tolerance = {}}, 25);
  EXPECT_EQ(warning_of(lab).find("tolerance"), std::string::npos) << warning_of(lab);
  EXPECT_NE(warning_of(lab).find("of the motion: "), std::string::npos) << warning_of(lab);
}

// A vibration of the wrong frequency is off while it lasts, and right at rest.
TEST(AccumulatedWarning, NamesTheLargestErrorOfARunThatEndsRight) {
  TestSim sim = vibration();
  sim.system.drag = 4.0;
  const Lab lab = run(sim, {.integrator = find_integrator("implicit_midpoint"), .substeps = 1, .tolerance = {}}, 250);
  ASSERT_TRUE(lab.accuracy().accumulated.value);
  EXPECT_LT(*lab.accuracy().accumulated.value, 1e-3);
  Accuracy accuracy = lab.accuracy();
  EXPECT_GT(accuracy.max_accumulated.error, 1e-3);
  accuracy.max_accumulated.error = 0.1;
  accuracy.max_accumulated.time = 0.25;
  EXPECT_EQ(accumulated_warning(accuracy).value_or("").find("accumulated error of up to 100 mm at 0.25 s, "), 0u);
}

// What the second run did not see may be anything.
TEST(AccumulatedWarning, IsGivenWhereTheSecondRunFailed) {
  Accuracy accuracy{.is_on = true, .size = 1.0};
  accuracy.motion = 2.0;
  accuracy.accumulated = {.reason = "the run with half the step, or a smaller tolerance, failed or took too long"};
  accuracy.loss = Loss::NoSecondRun;
  accuracy.accumulated_time = 0.65;
  accuracy.is_smooth = false;
  const std::string unknown =
      "accumulated error not known from 0.65 s on: the run with half the step, or a smaller tolerance, failed or took too long; ";
  const std::string remedy = "no setting with a smaller error is known, because of contact, a strain limit or the hand";
  EXPECT_EQ(accumulated_warning(accuracy), unknown + remedy);
  accuracy.max_accumulated.error = 2.8;
  accuracy.max_accumulated.time = 0.6;
  EXPECT_EQ(accumulated_warning(accuracy), unknown + "error of up to 2.8 m at 0.6 s, 1.4 times the motion; " + remedy);
}

TEST(AccumulatedWarning, LeavesChaoticMotionToItsPredictability) {
  Accuracy accuracy{.is_on = true, .size = 1.0};
  accuracy.motion = 1.0;
  accuracy.growth_rate.value = 3.0;
  accuracy.accumulated.value = 0.08;
  EXPECT_EQ(accumulated_warning(accuracy),
            "accumulated error of about 80 mm, 8 % of the motion: small differences grow, so that only averages are meaningful");
  accuracy.accumulated = {.reason = "beyond the time for which the motion can be predicted"};
  accuracy.loss = Loss::Unpredictable;
  EXPECT_EQ(accumulated_warning(accuracy),
            "the positions are beyond the time for which the motion can be predicted: only averages are meaningful");

  // energy from nowhere is no average to rely on
  accuracy.energy.change = 0.02;
  accuracy.energy.scale = 1.0;
  EXPECT_TRUE(accumulated_warning(accuracy).value_or("").ends_with(": only averages are meaningful"));
  accuracy.energy.change = 5.7;
  EXPECT_EQ(accumulated_warning(accuracy),
            "the positions are beyond the time for which the motion can be predicted: not even averages are meaningful, because the method "
            "has gained 570 % of the energy supplied");
}

TEST(AccumulatedWarning, IsGivenWhereTheMethodDissipatedTheMotion) {
  TestSim sim = vibration();
  const Lab lab = run(sim, {.integrator = find_integrator("implicit_euler"), .substeps = 1, .tolerance = {}}, 20 * 60);
  ASSERT_FALSE(lab.accuracy().accumulated.value);
  EXPECT_TRUE(warning_of(lab).starts_with("accumulated error not known: the method dissipated the motion, and would with half the step"))
      << warning_of(lab);
}

}  // namespace
}  // namespace hooke
