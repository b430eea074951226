// The one judgement of a run, which every line about its accuracy shares.
#include "lab/accuracy/judgement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lab/accuracy/accuracy_text.h"
#include "scene/parameters.h"
#include "sim/control/automatic.h"
#include "support/apply_now.h"
#include "support/flat_scene.h"
#include "support/measured_lab.h"
#include "support/small_net.h"

namespace hooke {
namespace {

using Level = Judgement::Level;

// Three masses in a row, of which the first is pulled.
Scene three_masses(const char* method, int substeps) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const PointId nail = sim.nail(Vec3(0.0));
  const PointId a = sim.add({0.65, 0.0, 0.0}, 0.5), b = sim.add({1.0, 0.0, 0.0}, 0.5), c = sim.add({1.5, 0.0, 0.0}, 0.5);
  sim.join(nail, a, 20.0, 0.5);
  sim.join(a, b, 20.0, 0.5);
  sim.join(b, c, 20.0, 0.5);
  return scene_of(sim, {.integrator = find_integrator(method), .substeps = substeps, .tolerance = {}});
}

Accuracy after(const Scene& scene, double seconds) {
  Lab lab = measured_lab(scene);
  for (int frame = 0; frame < 60.0 * seconds; ++frame) EXPECT_TRUE(lab.step());
  return lab.accuracy();
}

TEST(Judgement, OfAMotionThatTheMethodDissipatedIsBadAndSaysSo) {
  const Accuracy accuracy = after(three_masses("implicit_euler", 1), 7.5);
  ASSERT_TRUE(accuracy.frame.value);
  EXPECT_LT(*accuracy.frame.value, 1e-3);  // by itself, the error of a frame looks harmless
  const Judgement judgement = judge(accuracy);
  EXPECT_EQ(judgement.level, Level::Bad);
  EXPECT_TRUE(judgement.text.starts_with("motion dissipated by the method: ")) << judgement.text;
  EXPECT_TRUE(judgement.text.ends_with(" % of the energy")) << judgement.text;
  EXPECT_TRUE(accuracy_line(accuracy).starts_with(judgement.text)) << accuracy_line(accuracy);
  EXPECT_EQ(accuracy_lines(accuracy).back(), "motion dissipated");
}

TEST(Judgement, OfAnAccurateRunIsGood) {
  for (const char* method : {"velocity_verlet", "runge_kutta4", "dop853"}) {
    const Accuracy accuracy = after(three_masses(method, 20), 7.5);
    EXPECT_EQ(judge(accuracy).level, Level::Good) << method << ": " << judge(accuracy).text;
    EXPECT_TRUE(accuracy_line(accuracy).starts_with("error ")) << accuracy_line(accuracy);
  }
}

// It does not get better where something else gets worse.
TEST(Judgement, IsThatOfTheWorst) {
  Accuracy accuracy{.is_on = true, .size = 1.0, .frame = {.value = 1e-6}, .motion = 1.0};
  accuracy.energy.scale = 1.0;
  EXPECT_EQ(judge(accuracy).level, Level::Good);
  accuracy.frame.value = 2e-3;
  EXPECT_EQ(judge(accuracy).level, Level::Doubtful);
  EXPECT_EQ(judge(accuracy).text, "error of a frame 2 mm, 0.2 % of the size");
  accuracy.accumulated.value = 0.3;
  EXPECT_EQ(judge(accuracy).text, "accumulated error 300 mm, 30 % of the motion");
  accuracy.energy.change = 0.5;
  EXPECT_EQ(judge(accuracy).level, Level::Bad);
  EXPECT_EQ(judge(accuracy).text, "energy gained by the method: 50 % of what was supplied");
  accuracy.energy.change = -0.99;
  accuracy.loss = Loss::Dissipated;
  EXPECT_EQ(judge(accuracy).text, "motion dissipated by the method: 99 % of the energy");
}

TEST(FrameError, IsMeasuredAgainWhenSomethingTouches) {
  TestSim sim;
  sim.add({0.0, 1.0, 0.0});
  sim.system.colliders = {{.shape = Plane{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, .restitution = 0.5}};
  Lab lab = measured_lab(scene_of(sim, {.substeps = 4, .tolerance = {}}), AccuracyMode::Frame);
  while (lab.last_frame().motion().energy[EnergyCause::Contact] == 0.0) {
    ASSERT_TRUE(lab.step());
    ASSERT_LT(lab.scene().state.time, 1.0);
  }
  EXPECT_EQ(lab.accuracy().frame_time, lab.scene().state.time);
  EXPECT_TRUE(lab.accuracy().frame.value);
}

TEST(FrameError, IsNeverOldInTheWindowAndShowsItsAgeOtherwise) {
  Lab lab = measured_lab(three_masses("velocity_verlet", 20));
  for (int frame = 0; frame < 200; ++frame) {
    ASSERT_TRUE(lab.step());
    ASSERT_LE(lab.accuracy().time - lab.accuracy().frame_time, 0.2) << frame;
  }
  Accuracy accuracy{.is_on = true, .frame = {.value = 2.2e-5}, .frame_time = 1.0, .time = 1.2};
  EXPECT_EQ(accuracy_line(accuracy), "error 22 μm/frame");
  accuracy.time = 1.66;
  EXPECT_EQ(accuracy_line(accuracy), "error 22 μm/frame (0.66 s ago)");
}

// Neither the error of a run nor its history depends on how fast it is shown.
TEST(SlowMotion, IsNoEditOfTheRun) {
  Scene scene = three_masses("auto", 20);
  Lab lab(scene);
  lab.submit(SetRunning{true});
  for (int frame = 0; frame < 90; ++frame) lab.advance(1.0 / 60.0, [] { return true; });
  lab.measure_accuracy([] { return true; });
  const Accuracy before = lab.accuracy();
  const auto choice = lab.scene().state.memory.choice;
  ASSERT_TRUE(before.frame.value && before.accumulated.value && choice);
  lab.submit(Command(SetParameter{find_parameter("speed"), 0.25}));
  lab.apply_pending();
  const Accuracy after = lab.accuracy();
  EXPECT_EQ(after.frame.value, before.frame.value);
  EXPECT_EQ(after.accumulated.value, before.accumulated.value);
  EXPECT_EQ(lab.scene().state.memory.choice, choice);
  EXPECT_EQ(after.since, before.since);
  lab.submit(Undo{});
  lab.apply_pending();
  EXPECT_EQ(lab.accuracy().accumulated.value, before.accumulated.value);
}

TEST(SimulateTime, CountsWhatAutoComputesToChoose) {
  Lab lab(three_masses("auto", 20));
  lab.submit(SetRunning{true});
  for (int frame = 0; frame < 10; ++frame) lab.advance(1.0 / 60.0, [] { return true; });
  lab.publish();
  EXPECT_GT(lab.status()->run.simulate_ms(), 0.001);
}

TEST(SimulateTime, IsDividedIntoPhases) {
  const auto times = [](const char* method) {
    Scene scene = small_net();
    scene.settings.integrator = find_integrator(method);
    Lab lab(scene);
    for (int frame = 0; frame < 10; ++frame) lab.step();
    lab.measure_accuracy([] { return true; });
    lab.step();
    lab.publish();
    return lab.status()->run;
  };
  const RunStatus implicit = times("implicit_euler"), verlet = times("velocity_verlet");
  for (const Phase phase : {Phase::Forces, Phase::Contact, Phase::Solve, Phase::Accuracy}) EXPECT_GT(implicit.ms(phase), 0.0);
  EXPECT_EQ(implicit.ms(Phase::Auto), 0.0);
  EXPECT_EQ(verlet.ms(Phase::Solve), 0.0);
  EXPECT_GT(verlet.ms(Phase::Contact), 0.0);
  EXPECT_GT(times("auto").ms(Phase::Auto), 0.0);
}

// What was measured of the run that failed is gone when it goes on.
TEST(Divergence, LeavesNoErrorOfTheFailedRunBehind) {
  Scene scene = three_masses("velocity_verlet", 1);
  for (Index s = 0; s < scene.system.spring_count(); ++s) scene.system.spring(s)->stiffness = 1e6;
  Lab lab(scene);
  lab.submit(SetRunning{true});
  for (int frame = 0; frame < 600 && lab.status()->diagnosis.message.empty(); ++frame) {
    lab.advance(1.0 / 60.0, [] { return true; });
    lab.measure_accuracy([] { return true; });
  }
  ASSERT_FALSE(lab.status()->diagnosis.message.empty());
  lab.submit(Command(SetParameter{find_parameter("substeps"), 400}));
  lab.submit(SetRunning{true});
  lab.advance(1.0 / 60.0, [] { return true; });
  lab.measure_accuracy([] { return true; });
  const Accuracy accuracy = lab.accuracy();
  EXPECT_LT(accuracy.accumulated.value.value_or(0.0), 1e4 * accuracy.size);
  EXPECT_LT(accuracy.max_accumulated.error, 1e4 * accuracy.size);
}

}  // namespace
}  // namespace hooke
