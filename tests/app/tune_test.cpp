// Keys that change the stiffness and the number of substeps.
#include "app/tools/tools.h"
#include "sim/control/automatic.h"

#include <gtest/gtest.h>

#include "app/tools/tune.h"
#include "formats/scene_file.h"
#include "scene/parameters.h"
#include "support/tool_fixture.h"
#include "support/tool_scenes.h"

namespace hooke {
namespace {

// The effect of the arrow keys.

Scene sprung_scene(std::initializer_list<double> stiffnesses) {
  TestSim sim;
  std::vector<PointId> points = {sim.add(Vec3(0.0))};
  for (const double k : stiffnesses) {
    points.push_back(sim.add({0.1 * static_cast<double>(points.size()), 0.0, 0.0}));
    sim.join(points[points.size() - 2], points.back(), k, 0.1);
  }
  Scene scene;
  scene.system = sim.system;
  scene.state = sim.state;
  return scene;
}

void submit_all(ToolFixture& fixture, const Tuning& tuning) {
  const Gesture gesture = fixture.context.begin_gesture();
  for (const Command& command : tuning.commands) fixture.lab.submit(command, gesture);
  fixture.settle();
}

TEST(Tune, StiffnessScalesEverySpringByATenthAsOneStepAndLeavesNewOnes) {
  ToolFixture fixture(sprung_scene({100.0, 40.0}));
  const Tuning tuning = tune_stiffness(*fixture.context.status, {}, +1);
  EXPECT_EQ(tuning.message, "k = 44 to 110 N/m (all springs)");
  submit_all(fixture, tuning);
  EXPECT_DOUBLE_EQ(fixture.system().springs()[0].stiffness, 110.0);
  EXPECT_DOUBLE_EQ(fixture.system().springs()[1].stiffness, 44.0);
  EXPECT_EQ(fixture.context.status->document->defaults.stiffness, 100.0);
  fixture.submit(Undo{});
  EXPECT_EQ(fixture.system().springs()[0].stiffness, 100.0);
  EXPECT_EQ(fixture.system().springs()[1].stiffness, 40.0);
}

TEST(Tune, StiffnessKeepsTheRatioOfDifferentValuesAtTheEndsOfTheRange) {
  ToolFixture fixture(sprung_scene({2e5, 1e5}));
  const auto ratio = [&] { return fixture.system().springs()[0].stiffness / fixture.system().springs()[1].stiffness; };
  for (int i = 0; i < 40; ++i) submit_all(fixture, tune_stiffness(*fixture.context.status, {}, +1));
  EXPECT_NEAR(fixture.system().springs()[0].stiffness, 1e6, 1e-3);
  EXPECT_NEAR(ratio(), 2.0, 1e-9);
  for (int i = 0; i < 250; ++i) submit_all(fixture, tune_stiffness(*fixture.context.status, {}, -1));
  EXPECT_NEAR(fixture.system().springs()[1].stiffness, 0.01, 1e-9);
  EXPECT_NEAR(ratio(), 2.0, 1e-9);
}

TEST(Tune, StiffnessOfASelectionLeavesOtherSpringsUnchanged) {
  ToolFixture fixture(sprung_scene({100.0, 40.0}));
  submit_all(fixture, tune_stiffness(*fixture.context.status, {{}, {fixture.system().springs()[1].id}}, -1));
  EXPECT_EQ(fixture.system().springs()[0].stiffness, 100.0);
  EXPECT_DOUBLE_EQ(fixture.system().springs()[1].stiffness, 40.0 / 1.1);
  EXPECT_EQ(fixture.context.status->document->defaults.stiffness, 100.0);
}

TEST(Tune, StiffnessFollowsTheStepsAndLimitsOfTheScene) {
  Scene scene = sprung_scene({});
  scene.controls = {0.1, 10.0, 0.1};
  scene.defaults.stiffness = 9.9;
  ToolFixture fixture(scene);
  for (const double expected : {10.0, 10.0}) {
    submit_all(fixture, tune_stiffness(*fixture.context.status, {}, +1));
    EXPECT_DOUBLE_EQ(fixture.context.status->document->defaults.stiffness, expected);
  }
  for (int i = 0; i < 120; ++i) submit_all(fixture, tune_stiffness(*fixture.context.status, {}, -1));
  EXPECT_DOUBLE_EQ(fixture.context.status->document->defaults.stiffness, 0.1);
}

TEST(Tune, TheToleranceOfTheAutomaticMethodIsHalvedAndDoubledWithinItsRange) {
  Scene scene = sprung_scene({100.0});
  scene.settings = empty_scene().settings;
  ToolFixture fixture(scene);
  EXPECT_EQ(tune_substeps(*fixture.context.status, +1).message, "Tolerance 0.0005 m/s");
  const auto tolerance = [&] { return automatic_tolerance(fixture.context.snapshot().settings); };
  submit_all(fixture, tune_substeps(*fixture.context.status, +1));
  EXPECT_EQ(tolerance(), 5e-4);
  submit_all(fixture, tune_substeps(*fixture.context.status, -1));
  EXPECT_EQ(tolerance(), 1e-3);
  EXPECT_EQ(fixture.context.snapshot().settings.substeps, Settings().substeps);
  for (int i = 0; i < 40; ++i) submit_all(fixture, tune_substeps(*fixture.context.status, +1));
  EXPECT_EQ(tolerance(), tolerance_parameter.min);
}

TEST(Tune, SubstepsChangeByFivesFromOneToAThousand) {
  ToolFixture fixture(sprung_scene({}));
  const auto substeps = [&] { return fixture.context.snapshot().settings.substeps; };
  const auto set = [&](double value) {
    fixture.lab.submit(SetParameter{find_parameter("substeps"), value});
    fixture.settle();
  };
  set(1);
  submit_all(fixture, tune_substeps(*fixture.context.status, +1));
  EXPECT_EQ(substeps(), 5);
  submit_all(fixture, tune_substeps(*fixture.context.status, +1));
  EXPECT_EQ(substeps(), 10);
  set(7);
  submit_all(fixture, tune_substeps(*fixture.context.status, -1));
  EXPECT_EQ(substeps(), 5);
  submit_all(fixture, tune_substeps(*fixture.context.status, -1));
  EXPECT_EQ(substeps(), 1);
  set(998);
  const Tuning tuning = tune_substeps(*fixture.context.status, +1);
  submit_all(fixture, tuning);
  EXPECT_EQ(substeps(), 1000);
  EXPECT_EQ(tuning.message, "1000 substeps per frame");
  // of a file: more than the slider has
  set(5000);
  submit_all(fixture, tune_substeps(*fixture.context.status, +1));
  EXPECT_EQ(substeps(), 5000);
  submit_all(fixture, tune_substeps(*fixture.context.status, -1));
  EXPECT_EQ(substeps(), 4995);
}

}  // namespace
}  // namespace hooke
