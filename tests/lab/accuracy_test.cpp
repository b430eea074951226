// The accuracy that the laboratory measures while it runs, compared with the true errors.
#include <gtest/gtest.h>

#include <numeric>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "formats/scene_file.h"
#include "lab/lab.h"
#include "scene/parameters.h"
#include "sim/control/automatic.h"
#include "sim/control/frame_runner.h"
#include "sim/methods/rows.h"
#include "sim/model/hash.h"
#include "support/accuracy_scenes.h"
#include "support/convergence.h"
#include "support/flat_scene.h"
#include "support/measured_lab.h"

namespace hooke {
namespace {

class MeasuredAccuracy : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, MeasuredAccuracy, testing::ValuesIn(every_method()), method_name);

// Without contact. Where the error is not known because the motion cannot be predicted, it must be large.
TEST_P(MeasuredAccuracy, TheAccumulatedErrorIsTheDistanceToTheExactRun) {
  for (const AccuracyScene& row : accuracy_scenes()) {
    if (row.has_contact) continue;
    const TestSim sim = row.make();
    Lab lab = measured_lab(scene_of(sim, accuracy_settings(method(), sim.system)));
    Lab exact(scene_of(sim, {.integrator = find_integrator("dop853"), .substeps = 4, .tolerance = 1e-13}), KeepStart::No);
    bool diverged = false;
    for (int frame = 0; frame < 60 && !diverged; ++frame) {
      diverged = !lab.step();
      ASSERT_TRUE(exact.step());
    }
    // a method that gains energy at every step
    ASSERT_TRUE(!diverged || method().stability == Stability::None) << row.name;
    if (diverged) continue;
    const double error = distance(lab.scene().state, exact.scene().state);
    const Accuracy accuracy = lab.accuracy();
    if (error < 1e-11) continue;  // rounding errors
    if (!accuracy.accumulated.value) {
      EXPECT_EQ(accuracy.accumulated.reason, "beyond the time for which the motion can be predicted") << row.name;
      EXPECT_GT(error, 0.01) << row.name;
      continue;
    }
    // a large error of motion that is not predictable for long is not known as well
    const bool is_small = error < 0.1 || accuracy.predictable.value == std::numeric_limits<double>::infinity();
    EXPECT_GT(*accuracy.accumulated.value, error / (is_small ? 3.0 : 4.0)) << row.name;
    EXPECT_LT(*accuracy.accumulated.value, error * 3.0) << row.name;
  }
}

// A spring that vibrates at 10 rad/s: until the method has damped it away, the error within each period is known within a factor of 3.
class DampedAccuracy : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, DampedAccuracy, testing::ValuesIn(methods_that(can_be_stable)), method_name);

TEST_P(DampedAccuracy, TheAccumulatedErrorIsNotClaimedOnceTheMethodDampedTheMotionAway) {
  TestSim sim;
  const double amplitude = 0.5;
  const PointId nail = sim.nail(Vec3(0.0));
  sim.join(nail, sim.add(Vec3(1.0 + amplitude, 0.0, 0.0), 1.0), 100.0, 1.0);
  sim.system.gravity = Vec3(0.0);
  Lab lab = measured_lab(scene_of(sim, {.integrator = &method(), .substeps = 1, .tolerance = {}}));
  constexpr int period = 38;  // frames
  double max_error = 0.0, max_claimed = 0.0;
  for (int frame = 1; frame <= 20 * 60; ++frame) {
    ASSERT_TRUE(lab.step());
    const State& state = lab.scene().state;
    const double error = std::abs(state.position[1].x - 1.0 - amplitude * std::cos(10.0 * state.time)) / std::sqrt(2.0);
    const Accuracy accuracy = lab.accuracy();
    if (!accuracy.accumulated.value && frame > period) {
      EXPECT_EQ(accuracy.accumulated.reason, "the method dissipated the motion, and would with half the step");
      EXPECT_LT(accuracy.energy.method(), -0.5 * 12.5);
      return;
    }
    max_error = std::max(max_error, error);
    max_claimed = std::max(max_claimed, accuracy.accumulated.value.value_or(0.0));
    if (frame % period != 0) continue;
    EXPECT_GT(max_claimed, max_error / 3.0) << state.time;
    EXPECT_LT(max_claimed, std::max(max_error * 3.0, 1e-9)) << state.time;
    max_error = max_claimed = 0.0;
  }
  EXPECT_NE(method().id, "implicit_euler");
}

// A heavy mass on a soft spring beside a light one on a stiff spring, which starts stretched and is not damped.
TestSim light_beside_heavy(double omega) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const PointId nail = sim.nail(Vec3(0.0)), other = sim.nail(Vec3(0.0, 1.0, 0.0));
  sim.join(nail, sim.add(Vec3(1.1, 0.0, 0.0), 1e3), 1e5, 1.0);
  sim.join(other, sim.add(Vec3(0.55, 1.0, 0.0), 1e-4), 1e-4 * omega * omega, 0.5);
  return sim;
}

// With half the step, a method dissipates such a vibration just as completely: the error must be known nevertheless.
class DissipatingAccuracy : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, DissipatingAccuracy,
                         testing::ValuesIn(methods_that([](const Integrator& method) { return method.energy == EnergyTrend::Falls; })),
                         method_name);

TEST_P(DissipatingAccuracy, KnowsVibrationsThatTheMethodDissipatesWithinAFrame) {
  for (const double omega : {1e3, 3e4, 3e5})
    for (const int substeps : {1, 20}) {
      const TestSim sim = light_beside_heavy(omega);
      Lab lab = measured_lab(scene_of(sim, {.integrator = &method(), .substeps = substeps, .tolerance = {}}));
      double max_claimed = 0.0;
      for (int frame = 0; frame < 60; ++frame) {
        ASSERT_TRUE(lab.step());
        max_claimed = std::max(max_claimed, lab.accuracy().accumulated.value.value_or(INFINITY));
      }
      // an amplitude of 0.05 m at one of four points
      const double lost = -lab.accuracy().energy.method(), energy = 0.5 * 1e-4 * omega * omega * 0.05 * 0.05;
      if (lab.accuracy().accumulated.value && lost > 0.5 * energy) {
        EXPECT_GT(max_claimed, 0.025 / 3.0) << omega << " " << substeps;
      }
    }
}

TEST(AutomaticAccuracy, ResolvesAVibrationThatIsLargerThanItsTolerance) {
  for (const double omega : {1e3, 1e4, 1e5})
    for (const double tolerance : {1e-2, 1e-3}) {
      const TestSim sim = light_beside_heavy(omega);
      Lab lab(scene_of(sim, {.integrator = &automatic_method(), .substeps = 1, .tolerance = tolerance}), KeepStart::No);
      double error = 0.0;
      bool is_reported = false;
      for (int frame = 0; frame < 30 && !is_reported; ++frame) {
        ASSERT_TRUE(lab.step());
        const State& state = lab.scene().state;
        is_reported = !is_tolerance_met(*state.memory.choice, lab.scene().settings);
        error = std::abs(state.position[3].x - 0.5 - 0.05 * std::cos(omega * state.time));
      }
      EXPECT_TRUE(is_reported || error < tolerance) << omega << " " << tolerance << ": " << error;
    }
}

TEST(MeasuredAccuracyOfALab, StartsAnewWithAnotherScene) {
  const TestSim sim = accuracy_scenes().front().make();
  const Scene scene = scene_of(sim, accuracy_settings(default_integrator(), sim.system));
  Lab lab = measured_lab(scene, AccuracyMode::Frame);
  for (int frame = 0; frame < 5; ++frame) lab.step();
  EXPECT_NE(lab.accuracy().energy.change, 0.0);
  lab.submit(Open{std::make_shared<const Scene>(scene)});
  lab.apply_pending();
  EXPECT_EQ(lab.accuracy().energy.change, 0.0);
  EXPECT_EQ(lab.accuracy().energy.change, 0.0);
}

TEST_P(MeasuredAccuracy, TheEnergyBalanceSumsToTheChange) {
  for (const AccuracyScene& row : accuracy_scenes()) {
    const TestSim sim = row.make();
    Lab lab = measured_lab(scene_of(sim, accuracy_settings(method(), sim.system)), AccuracyMode::Frame);
    const double start = compute_energy(lab.scene().system, lab.scene().state).total();
    double largest = std::abs(start);
    for (int frame = 0; frame < 30; ++frame) {
      if (frame == 10) lab.submit(Command(SetParameter{find_parameter("stiffness"), 150.0}));
      if (!lab.step()) break;
      const EnergyBalance balance = lab.accuracy().energy;
      const double now = compute_energy(lab.scene().system, lab.scene().state).total();
      largest = std::max({largest, std::abs(now), std::abs(balance.ledger[EnergyCause::Edits])});
      EXPECT_NEAR(balance.change, now - start, 1e-12 * largest) << row.name;
      EXPECT_NEAR(balance.ledger.sum() + balance.method(), balance.change, 1e-10 * largest) << row.name;
    }
  }
}

// The same states with the meter and without it
TEST_P(MeasuredAccuracy, MeasuringDoesNotChangeTheRun) {
  for (const AccuracyScene& row : accuracy_scenes()) {
    const TestSim sim = row.make();
    const Scene scene = scene_of(sim, accuracy_settings(method(), sim.system));
    Lab measured = measured_lab(scene), plain(scene, KeepStart::No);
    for (int frame = 0; frame < 10; ++frame) {
      measured.step();
      plain.step();
    }
    EXPECT_EQ(hash_state(measured.scene().state), hash_state(plain.scene().state)) << row.name;
    EXPECT_FALSE(plain.accuracy().frame.value);
    EXPECT_EQ(plain.accuracy().frame.reason, "switched off");
  }
}

// A chain of links from a nail, started level or in any other direction [rad].
TestSim pendulum(int links, double angle, double speed = 0.0) {
  TestSim sim;
  const Vec3 along(std::cos(angle), std::sin(angle), 0.0), across(-along.y, along.x, 0.0);
  PointId last = sim.nail(Vec3(0.0));
  for (int i = 1; i <= links; ++i) {
    const PointId next = sim.add(0.5 * i * along, 1.0, speed * i * across);
    sim.join(last, next, 1e4, 0.5);
    last = next;
  }
  return sim;
}

// The rate of growth that is measured within 4 s [1/s].
double growth_rate_of(const TestSim& sim) {
  const Integrator& verlet = default_integrator();
  Lab lab = measured_lab(scene_of(sim, accuracy_settings(verlet, sim.system)));
  double rate = 0.0;
  for (int frame = 0; frame < 240; ++frame) {
    EXPECT_TRUE(lab.step());
    rate = std::max(rate, lab.accuracy().growth_rate.value.value_or(0.0));
  }
  return rate;
}

TEST(Predictability, TenOfTenChaoticScenesAreRecognized) {
  const std::vector<std::pair<const char*, TestSim>> scenes{
      {"double pendulum", pendulum(2, 1.5)},
      {"drum without tension", accuracy_scene::drum()},
      {"triple pendulum", pendulum(3, 0.4)},
      {"pendulum of five links", pendulum(5, 0.0)},
      {"rope released level", accuracy_scene::rope()},
      {"soft curtain", curtain(8, 1e2, 0.0)},
      {"stiff curtain", curtain(8, 1e4, 0.0)},
      {"damped curtain", curtain(8, 1e4, 0.1)},
      {"cloth", cloth(8)},
      {"cloth moved by a hand", accuracy_scene::held()},
  };
  for (const auto& [name, sim] : scenes) EXPECT_GT(growth_rate_of(sim), 0.5) << name;
}

TEST(Predictability, TenOfTenRegularScenesAreRecognized) {
  TestSim orbit;  // two masses on a spring that turn about each other
  orbit.system.gravity = Vec3(0.0);
  orbit.join(orbit.add({-0.5, 0.0, 0.0}, 1.0, {0.0, 1.0, 0.0}), orbit.add({0.5, 0.0, 0.0}, 1.0, {0.0, -1.0, 0.0}), 100.0, 0.9);
  TestSim fall;
  fall.join(fall.add(Vec3(0.0)), fall.add({1.0, 0.0, 0.0}, 2.0), 50.0, 0.8);
  const std::vector<std::pair<const char*, TestSim>> scenes{
      {"net", net(8, 1e2, 0.0)},
      {"stiff net", net(8, 1e4, 0.0)},
      {"damped net", net(8, 1e3, 0.5)},
      {"net of 16 x 16", net(16, 1e2, 0.0)},
      {"net in the wind", accuracy_scene::wind()},
      {"pulled net", accuracy_scene::pulled()},
      {"pendulum", pendulum(1, -1.0)},
      {"double pendulum that swings a little", pendulum(2, -1.5)},
      {"orbit", orbit},
      {"fall", fall},
  };
  for (const auto& [name, sim] : scenes) EXPECT_EQ(growth_rate_of(sim), 0.0) << name;
}

// What measuring costs, in substeps instead of seconds; one frame in four also with a quarter of the step where something may touch.
class RepeatedSubsteps : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(WithoutAndWithAFloor, RepeatedSubsteps, testing::Bool());
TEST_P(RepeatedSubsteps, AreATwentiethOfAllOrALittleMoreWhereSomethingMayTouch) {
  TestSim sim = net(8, 1e2, 0.0);
  if (GetParam()) sim.system.colliders.push_back({.shape = Plane{.point = {0.0, -100.0, 0.0}}});
  // a method that computes its substeps one by one, so that calls count them
  const Settings settings{.integrator = &runge_kutta4, .substeps = 10};
  Plan plan = make_plan(sim.system);
  FrameRunner frame;
  AccuracyMeter meter;
  meter.set_mode(AccuracyMode::Frame);
  long substeps = 0, repeated = 0;
  for (int i = 0; i < 400; ++i) {
    State after = sim.state;
    frame.begin(plan, sim.system, settings, sim.state);
    for (; !frame.done(); ++substeps) frame.substep(plan);
    frame.end(plan, after);
    meter.add_frame(plan, sim.system, settings, sim.state, after, frame.motion(), 0.0, 0.0);
    for (; meter.is_repeating(); ++repeated) meter.repeat(sim.system);
    sim.state = after;
  }
  EXPECT_GE(static_cast<double>(repeated), (GetParam() ? 0.06 : 0.04) * static_cast<double>(substeps));
  EXPECT_LE(static_cast<double>(repeated), (GetParam() ? 0.086 : 0.051) * static_cast<double>(substeps));
}

TEST(AccuracyMeter, AfterAnEditTheErrorIsUnknownUntilTheNextMeasurement) {
  const TestSim sim = net(8, 1e2, 0.0);
  Lab lab = measured_lab(scene_of(sim, {}));
  lab.apply_pending();
  EXPECT_EQ(lab.accuracy().frame.reason, "not measured yet");
  for (int frame = 0; frame < 5; ++frame) lab.step();
  ASSERT_TRUE(lab.accuracy().frame.value);
  EXPECT_EQ(lab.accuracy().frame_time, 1.0 / 60.0);
  lab.submit(Command(SetParameter{find_parameter("stiffness"), 150.0}));
  lab.apply_pending();
  EXPECT_FALSE(lab.accuracy().frame.value);
  EXPECT_EQ(lab.accuracy().frame.reason, "not yet measured since the last edit");
  lab.step();
  EXPECT_TRUE(lab.accuracy().frame.value);
  EXPECT_TRUE(lab.accuracy().accumulated.value);
}

// Without idle time too, nothing that was measured before an edit is shown after it.
TEST(AccuracyMeter, NoErrorOfBeforeAnEditIsShownAfterIt) {
  const TestSim sim = net(8, 1e2, 0.0);
  Lab lab(scene_of(sim, {}));
  lab.submit(Control(SetRunning{true}));
  const auto run_until_known = [&] {
    int frames = 0;
    while (!lab.accuracy().frame.value && frames < 60) {
      lab.advance(1.0 / 60.0, [] { return true; });
      ++frames;
    }
    return frames;
  };
  EXPECT_LE(run_until_known(), 12);
  const PointId held = sim.system.points()[30].id;
  for (const Command& edit : {Command(GrabPoint{GrabPoint::Item{.point = held, .target = sim.position(held)}}), Command(ReleaseHand{}),
                              Command(SetParameter{find_parameter("stiffness"), 150.0})}) {
    const double before = lab.scene().state.time;
    lab.submit(edit);
    lab.advance(1.0 / 60.0, [] { return true; });
    EXPECT_TRUE(!lab.accuracy().frame.value || lab.accuracy().frame_time > before);
    EXPECT_LE(run_until_known(), 12);
    EXPECT_GT(lab.accuracy().frame_time, before);
  }
}

// A window that has no idle time: a frame is repeated beside the ones that follow.
TEST(AccuracyMeter, WhereSomethingHitsTheErrorOfThatFrameIsKnownSoon) {
  TestSim sim;
  sim.add({0.0, 1.0, 0.0});
  sim.system.colliders.push_back({.shape = Plane{}, .restitution = 0.5});
  Lab lab(scene_of(sim, {.substeps = 24}));
  lab.submit(Control(SetRunning{true}));
  double hit = 0.0, known = 0.0;
  for (int frame = 0; frame < 120 && known == 0.0; ++frame) {
    lab.advance(1.0 / 60.0, [] { return true; });
    const double now = lab.scene().state.time;
    if (hit == 0.0 && lab.scene().state.velocity[0].y > 0.0) hit = now;
    if (hit > 0.0 && lab.accuracy().frame_time >= hit) known = now;
  }
  ASSERT_GT(hit, 0.0);
  ASSERT_GT(known, 0.0);
  EXPECT_LT(known - hit, 0.25) << "[s]";
}

// The substeps reported for half the error give half the error.
TEST(AccuracyMeter, HalfTheErrorCostsAsMuchAsReported) {
  const TestSim sim = net(8, 1e2, 0.0);
  for (const char* id : {"velocity_verlet", "implicit_euler", "tr_bdf2", "runge_kutta4"}) {
    const auto error_with = [&](int substeps, int& half) {
      Lab lab = measured_lab(scene_of(sim, {.integrator = find_integrator(id), .substeps = substeps}), AccuracyMode::Frame);
      for (int frame = 0; frame < 25; ++frame) lab.step();
      half = lab.accuracy().half_error.substeps;
      EXPECT_NEAR(lab.accuracy().half_error.cost, static_cast<double>(half) / substeps, 1e-12);
      return *lab.accuracy().frame.value;
    };
    int half = 0, quarter = 0;
    const double error = error_with(20, half), less = error_with(half, quarter);
    EXPECT_NEAR(less / error, 0.5, 0.1) << id << ": " << half << " substeps";
  }
}

}  // namespace
}  // namespace hooke
