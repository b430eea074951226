// What the accuracy of a run says where a collider oscillates: bounces on a plate against an exact solution that goes from impact to
// impact.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "sim/control/automatic.h"
#include "sim/control/frame_error.h"
#include "sim/methods/integrator.h"
#include "support/measured_lab.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

constexpr double g = 9.81, radius = 0.02;

struct Plate {
  double amplitude, frequency, phase, restitution;
  ColliderPath path() const { return {.amplitude = {0.0, amplitude, 0.0}, .frequency = frequency, .phase = phase}; }
};

// The height of a ball that falls from rest at y onto the plate, after this time [s].
double exact_height(const Plate& plate, double y, double seconds) {
  const ColliderPath path = plate.path();
  double t = 0.0, v = 0.0;
  const auto height = [&](double s) { return y + v * s - 0.5 * g * s * s; };
  const auto gap = [&](double s) { return height(s) - radius - path.offset(t + s).y; };
  const double part = 1.0 / (2000.0 * plate.frequency);
  while (true) {
    double s = 1e-9;
    while (t + s < seconds && !(gap(s + part) < 0.0)) s += part;
    if (t + s >= seconds) return height(seconds - t);
    double before = s, after = s + part;
    for (int i = 0; i < 80; ++i) (gap(0.5 * (before + after)) < 0.0 ? after : before) = 0.5 * (before + after);
    y = height(before);
    v -= g * before;
    t += before;
    const double speed = path.velocity(t).y;
    if (v < speed) v = speed + plate.restitution * (speed - v);
  }
}

Scene ball_on(const Plate& plate, double y, const Settings& settings) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0, -g, 0.0);
  sim.system.dimensions = 2;
  sim.system.colliders = {{.shape = Plane{}, .restitution = plate.restitution, .path = plate.path()}};
  sim.add({0.0, y, 0.0});
  sim.system.point(0).radius = radius;
  return scene_of(sim, settings);
}

struct Outcome {
  double y;
  Accuracy accuracy;
};
Outcome run(const Plate& plate, double y, double seconds, const Settings& settings) {
  Lab lab = measured_lab(ball_on(plate, y, settings));
  for (int frame = 0; frame < static_cast<int>(std::lround(60.0 * seconds)); ++frame) EXPECT_TRUE(lab.step());
  return {lab.scene().state.position[0].y, lab.accuracy()};
}

// A step as long as the fall passes over several oscillations of the plate.
TEST(OscillatingCollider, AMethodThatAdaptsItsStepDoesNotPassOverImpacts) {
  for (const Plate& plate : {Plate{0.005, 60.0, 1.5707963, 0.9}, Plate{0.01, 480.0, 0.0, 0.5}, Plate{0.002, 200.0, 0.3, 0.7}})
    for (const double y : {0.1, 0.3}) {
      const double exact = exact_height(plate, y, 1.0);
      const Outcome found = run(plate, y, 1.0, {.integrator = find_integrator("dop853"), .substeps = 1, .tolerance = 1e-8});
      const double error = std::abs(found.y - exact);
      if (!found.accuracy.accumulated.value) continue;
      EXPECT_GT(*found.accuracy.accumulated.value, error / 3.0) << plate.frequency << " " << y;
    }
}

// At 240 Hz, the frames and all halves of their steps down to a sixteenth of a frame end at the same phase.
TEST(OscillatingCollider, NoErrorIsClaimedWhereTheStepsDoNotResolveIt) {
  const double half_pi = 0.5 * std::numbers::pi;
  for (const char* id : {"velocity_verlet", "implicit_midpoint", "xpbd"})
    for (const int substeps : {1, 2, 20}) {
      const Plate plate{0.001, substeps == 20 ? 2400.0 : 240.0, half_pi, 0.5};
      const Accuracy accuracy = run(plate, 0.1, 1.0, {.integrator = find_integrator(id), .substeps = substeps}).accuracy;
      EXPECT_FALSE(accuracy.accumulated.value) << id << " " << substeps << " " << accuracy.accumulated.value.value_or(0.0);
      EXPECT_FALSE(accuracy.frame.value);
      for (const Measured& each : {accuracy.accumulated, accuracy.frame})
        EXPECT_EQ(each.reason, "a collider or muscle oscillates faster than the steps resolve");
      EXPECT_EQ(accuracy.half_error.reason, "a collider or muscle oscillates faster than the steps resolve");
      EXPECT_EQ(accuracy.loss, Loss::Unresolved);
    }
  // a large distance from half the step, four times smaller than the error
  const Outcome coarse = run({0.0048, 380.6, 1.0, 0.5}, 0.3, 1.0, {.integrator = find_integrator("velocity_verlet"), .substeps = 20});
  EXPECT_FALSE(coarse.accuracy.accumulated.value);
}

// A mass on a muscle whose frequency is a multiple of the frame rate, so that frames see it at one phase: x'' = -w^2 (x - a sin(W t + p)),
// p 0 or pi. HOOKE_SEED: other muscles.
TEST(OscillatingMuscle, IsResolvedByAutoAndNoErrorIsClaimedElsewhere) {
  const char* seed = std::getenv("HOOKE_SEED");
  Random random(seed != nullptr ? std::strtoull(seed, nullptr, 10) : 1);
  for (int i = 0; i < 8; ++i) {
    const double frequency = 60.0 * (1 + random.below(4)), phase = std::numbers::pi * random.below(2), a = random.uniform(0.05, 0.5);
    const double w2 = random.uniform(100.0, 5000.0), w = std::sqrt(w2), omega = 2.0 * std::numbers::pi * frequency, seconds = 0.5;
    TestSim sim;
    sim.system.dimensions = 2;
    sim.system.gravity = Vec3(0.0);
    const PointId nail = sim.nail(Vec3(0.0)), mass = sim.add({1.0, 0.0, 0.0});
    const SpringId muscle = sim.join(nail, mass, w2, 1.0);
    sim.system.spring(sim.system.index_of(muscle))->law = SpringLaw{.amplitude = a, .frequency = frequency, .phase = phase};
    const double driven = (phase == 0.0 ? a : -a) * w2 / (w2 - omega * omega);
    const double exact = 1.0 + driven * (std::sin(omega * seconds) - omega / w * std::sin(w * seconds));
    for (const char* id : {"auto", "velocity_verlet", "runge_kutta4"}) {
      const Settings settings{.integrator = find_integrator(id), .substeps = 4, .tolerance = 1e-6};
      Lab lab = measured_lab(scene_of(sim, settings));
      for (int frame = 0; frame < 30; ++frame) ASSERT_TRUE(lab.step()) << id << " " << frequency;
      const double error = std::abs(lab.scene().state.position[1].x - exact);
      const auto claimed = lab.accuracy().accumulated.value;
      EXPECT_EQ(claimed.has_value(), std::string(id) == "auto") << id << " " << frequency;
      if (!claimed) continue;
      EXPECT_GT(*claimed, error / 3.0);
      EXPECT_LT(error, 1e-4 * a);
      const EnergySupply& supply = lab.scene().state.supply;
      EXPECT_NEAR(supply.net_input, lab.energy().total(), 1e-2 * supply.scale) << frequency;
    }
  }
}

TEST(OscillatingCollider, AutoChoosesSubstepsThatResolveIt) {
  for (const double frequency : {240.0, 2400.0}) {
    const Plate plate{0.24 / frequency, frequency, 0.5 * std::numbers::pi, 0.5};
    const Settings settings{.integrator = find_integrator("auto"), .tolerance = 1e-6};
    Lab lab = measured_lab(ball_on(plate, 0.1, settings));
    for (int frame = 0; frame < 60; ++frame) {
      ASSERT_TRUE(lab.step());
      EXPECT_TRUE(resolves_oscillations(lab.plan(), settings_used(settings, lab.scene().state)));
    }
    const double exact = exact_height(plate, 0.1, 1.0), error = std::abs(lab.scene().state.position[0].y - exact);
    const Accuracy accuracy = lab.accuracy();
    ASSERT_TRUE(accuracy.accumulated.value);
    EXPECT_GT(*accuracy.accumulated.value, error / 3.0) << frequency;
  }
}

}  // namespace
}  // namespace hooke
