// The energy balance and the error estimates of frames in which springs break.
#include <gtest/gtest.h>

#include "sim/control/frame_error.h"
#include "support/gas_bodies.h"
#include "support/measured_lab.h"
#include "support/run_lab.h"

namespace hooke {
namespace {

// Two points of 1 kg that fly apart at `speed` [m/s] each, on a spring that breaks at 10 %.
TestSim breaking_pair(double speed) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const PointId left = sim.add({-0.5, 0.0, 0.0}, 1.0, {-speed, 0.0, 0.0}), right = sim.add({0.5, 0.0, 0.0}, 1.0, {speed, 0.0, 0.0});
  sim.join(left, right, 100.0, 1.0, 1.0);
  sim.system.spring(0)->break_strain = 0.1;
  return sim;
}

// [J], of its dashpot until it breaks: 1/2 u'' = -k u - d u', by a step far shorter than that of the run.
double dissipated_by_pair(double speed) {
  constexpr double h = 1e-6;
  double u = 0.0, v = 2.0 * speed, sum = 0.0;
  while (u < 0.1) {
    v -= h * 2.0 * (100.0 * u + v);
    u += h * v;
    sum += h * v * v;
  }
  return sum;
}

// At 5 m/s it breaks in the first frame, of which no other one tells what dashpots dissipate; more slowly in the second and the fourth.
TEST(TearAccounts, TheDashpotOfASpringThatBreaksDissipatesUntilThen) {
  for (const char* method : {"velocity_verlet", "dop853", "implicit_midpoint"})
    for (const double speed : {5.0, 2.0, 1.0}) {
      Lab lab = measured_lab(scene_of(breaking_pair(speed), {.integrator = find_integrator(method), .substeps = 40}), AccuracyMode::Frame);
      run(lab, 12);
      ASSERT_EQ(lab.scene().system.spring_count(), 0);
      const EnergyBalance balance = lab.accuracy().energy;
      const double supplied = speed * speed;
      EXPECT_NEAR(balance.ledger[EnergyCause::Dashpots], -dissipated_by_pair(speed), 0.01 * supplied) << method << ' ' << speed;
      EXPECT_NEAR(balance.method(), 0.0, 0.01 * supplied) << method << ' ' << speed;
      EXPECT_NEAR(balance.ledger.sum() + balance.method(), balance.change, 1e-12 * supplied) << method << ' ' << speed;
    }
}

TEST(TearAccounts, ASheetThatTearsLosesNothingToTheMethod) {
  Lab lab = measured_lab(weak_sheet(*find_integrator("velocity_verlet")), AccuracyMode::Frame);
  run(lab, 60);
  ASSERT_LT(lab.scene().system.spring_count(), weak_sheet(*find_integrator("velocity_verlet")).system.spring_count() - 4);
  const EnergyBalance balance = lab.accuracy().energy;
  EXPECT_LT(balance.ledger[EnergyCause::Dashpots], 0.0);
  EXPECT_NEAR(balance.method(), 0.0, 0.01 * lab.scene().state.supply.scale);
}

// A ring filled with gas that tears in its first frame, or later if it is stronger.
Scene weak_ring(int substeps, double break_strain = 0.05) {
  TestSim sim = gas_ring(12, 300.0, {.pressure = 100.0});
  for (Index s = 0; s < sim.system.spring_count(); ++s) sim.system.spring(s)->damping = 0.1;
  sim.system.spring(0)->break_strain = break_strain;
  Scene scene = scene_of(sim, {.integrator = find_integrator("velocity_verlet"), .substeps = substeps});
  initialize_supply(scene.system, scene.state);
  return scene;
}

struct RingRun {
  Lab lab;
  explicit RingRun(int substeps, int frames) : lab(measured_lab(weak_ring(substeps))) {
    run(lab, frames);
    EXPECT_EQ(lab.gas_releases().size(), 1u);
  }
  const EnergyBalance& energy() { return accuracy = lab.accuracy(), accuracy.energy; }
  Accuracy accuracy;
};

TEST(TearAccounts, AReleaseOfGasIsNeitherLossNorGain) {
  constexpr int frames = 60, substeps = 20;
  RingRun coarse(substeps, frames), fine(16 * substeps, frames);
  const double supplied = fine.energy().ledger.forces();
  ASSERT_GT(supplied, 0.0);
  EXPECT_NEAR(coarse.energy().ledger.forces(), supplied, 0.1 * supplied);
  EXPECT_NEAR(fine.energy().method(), 0.0, 0.01 * supplied);
  EXPECT_NEAR(coarse.energy().method(), 0.0, 0.01 * supplied);
  EXPECT_NEAR(coarse.energy().ledger[EnergyCause::Dashpots], fine.energy().ledger[EnergyCause::Dashpots], 0.05 * supplied);
}

// The gas leaves at the end of the frame in which the ring tears, with any substeps; the tear is late by up to a substep.
TEST(TearAccounts, TheErrorAfterAReleaseOfGasFallsWithTheStep) {
  constexpr int frames = 12, substeps = 20;
  const RingRun coarse(substeps, frames), finer(8 * substeps, frames), reference(128 * substeps, frames);
  const auto error_of = [&](const RingRun& run) {
    return weighted_distance(run.lab.scene().system, run.lab.scene().state.position, reference.lab.scene().state.position, 1.0).rms;
  };
  const Accuracy first = coarse.lab.accuracy(), second = finer.lab.accuracy();
  ASSERT_TRUE(first.accumulated.value && second.accumulated.value);
  EXPECT_EQ(first.since, 0.0);
  EXPECT_LT(*second.accumulated.value, 0.5 * *first.accumulated.value);
  EXPECT_LT(*first.accumulated.value, 8.0 * error_of(coarse));
  ASSERT_TRUE(first.frame.value && second.frame.value) << first.frame.reason << second.frame.reason;
  // of second order, 1/64, beside the rounding of the distance
  EXPECT_LT(*second.frame.value, *first.frame.value / 30.0);
}

// Beside a window, too: the values do not depend on when the work is done, as long as it keeps up.
TEST(TearAccounts, DoNotDependOnWhenTheWorkIsDone) {
  Lab at_once = measured_lab(weak_ring(20)), later(weak_ring(20));
  for (int frame = 0; frame < 30; ++frame) {
    run(at_once, 1);
    run(later, 1);
    later.measure_accuracy([] { return true; });
  }
  const Accuracy first = at_once.accuracy(), second = later.accuracy();
  EXPECT_EQ(first.accumulated.value, second.accumulated.value);
  EXPECT_EQ(first.frame.value, second.frame.value);
  EXPECT_EQ(first.energy, second.energy);
}

// Where it does not keep up, the run with half the step starts again after the tear.
TEST(TearAccounts, AFrameThatWaitsIsNotComputedWithoutItsSprings) {
  Lab lab(weak_ring(20, 0.3));
  while (lab.gas_releases().empty() && lab.scene().state.time < 0.5) run(lab, 1);
  ASSERT_EQ(lab.gas_releases().size(), 1u);
  run(lab, 6);
  lab.measure_accuracy([] { return true; });
  const Accuracy accuracy = lab.accuracy();
  ASSERT_TRUE(accuracy.accumulated.value) << accuracy.accumulated.reason;
  EXPECT_EQ(accuracy.since, lab.gas_releases()[0]);
  EXPECT_LT(*accuracy.accumulated.value, 1e-4);
}

}  // namespace
}  // namespace hooke
