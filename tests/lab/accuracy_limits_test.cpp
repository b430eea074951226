// What the accuracy of a run says where contact or a strain limit act in steps of their own, dashpots decay within a
// step, or wind dissipates the motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/methods/integrator.h"
#include "sim/step/divergence.h"
#include "support/force_with.h"
#include "support/measured_lab.h"
#include "support/nets.h"

namespace hooke {
namespace {

// A point falls until its spring may not become longer, once per substep: the tolerance of an adaptive method does not apply to that.
TEST(AccuracyMeter, AStrainLimitIsPartOfTheErrorOfEveryMethod) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0, -9.81, 0.0);
  const PointId nail = sim.nail(Vec3(0.0)), point = sim.add({1.0, 0.0, 0.0});
  sim.join(nail, point, 20.0, 1.0);
  sim.system.strain_limit = 0.1;
  for (const char* id : {"dop853", "velocity_verlet", "runge_kutta4"})
    for (const int substeps : {1, 4}) {
      Lab lab = measured_lab(scene_of(sim, {.integrator = find_integrator(id), .substeps = substeps}));
      Lab exact(scene_of(sim, {.integrator = find_integrator("runge_kutta4"), .substeps = 2048}), KeepStart::No);
      for (int frame = 0; frame < 60; ++frame) {
        ASSERT_TRUE(lab.step());
        ASSERT_TRUE(exact.step());
      }
      const double error = distance(lab.scene().state, exact.scene().state);
      const Accuracy accuracy = lab.accuracy();
      ASSERT_TRUE(accuracy.accumulated.value) << id << " " << accuracy.accumulated.reason;
      EXPECT_GT(*accuracy.accumulated.value, error / 3.0) << id << " " << substeps;
      EXPECT_LT(*accuracy.accumulated.value, 3.0 * error) << id << " " << substeps;
      if (lab.scene().settings.integrator->stability == Stability::Adaptive) {
        EXPECT_EQ(accuracy.half_error.reason, "contact and the strain limit hardly depend on the tolerance");
      }
    }
}

// A vibration that the method dissipates within a frame, beside a strong dashpot: half the step dissipates it, too.
TEST(AccuracyMeter, KnowsVibrationsBesideADashpotThatDecaysWithinAStep) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const PointId nail = sim.nail(Vec3(0.0)), other = sim.nail(Vec3(0.0, 1.0, 0.0));
  sim.join(nail, sim.add(Vec3(1.1, 0.0, 0.0), 1.0), 100.0, 1.0, 5e3);
  sim.join(other, sim.add(Vec3(0.55, 1.0, 0.0), 1e-3), 1e3, 0.5);
  const double omega = 1e3;
  for (const char* id : {"implicit_euler", "baraff_witkin", "xpbd"}) {
    Lab lab = measured_lab(scene_of(sim, {.integrator = find_integrator(id), .substeps = 1, .tolerance = {}}));
    double max_error = 0.0, max_claimed = 0.0;
    for (int frame = 0; frame < 60; ++frame) {
      ASSERT_TRUE(lab.step());
      const State& state = lab.scene().state;
      max_error = std::max(max_error, std::abs(state.position[3].x - 0.5 - 0.05 * std::cos(omega * state.time)) / 2.0);
      max_claimed = std::max(max_claimed, lab.accuracy().accumulated.value.value_or(0.0));
    }
    EXPECT_GT(max_claimed, max_error / 3.0) << id;
    EXPECT_LT(max_claimed, max_error * 3.0) << id;
  }
}

// Light balls on a spring in wind, which takes all of their energy, as the exact motion does.
TEST(AccuracyMeter, DoesNotTakeTheLossInWindForThatOfTheMethod) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const PointId first = sim.add(Vec3(0.0), 1e-3), second = sim.add({0.5, 0.0, 0.0}, 1e-3);
  for (const PointId point : {first, second}) sim.system.point(sim.system.index_of(point)).radius = 0.1;
  sim.join(first, second, 1000.0, 0.2);
  sim.system.forces = {force_with("wind", {{"x", 1.0}, {"z", 0.0}})};
  initialize_supply(sim.system, sim.state);
  Lab lab = measured_lab(scene_of(sim, {.integrator = find_integrator("velocity_verlet"), .substeps = 100}));
  for (int frame = 0; frame < 30; ++frame) ASSERT_TRUE(lab.step());
  const Accuracy accuracy = lab.accuracy();
  EXPECT_LT(accuracy.energy.ledger.forces(), -40.0);
  EXPECT_EQ(accuracy.accumulated.reason, "");
  EXPECT_LT(accuracy.accumulated.value.value_or(1.0), 1e-3);
}

}  // namespace
}  // namespace hooke
