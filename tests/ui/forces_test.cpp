// The group of forces of the side panel.
#include <gtest/gtest.h>

#include <cmath>

#include "formats/scene_file.h"
#include "sim/forces/force_terms.h"
#include "sim/forces/terms/rows.h"
#include "support/gui_fixture.h"

namespace hooke {
namespace {

Scene shipped_scene(const char* id) { return load_scene(find_scene(id)).scene; }

glm::dvec2 find_slider(GuiFixture& gui, const char* row) { return gui.find("side", {"pressure 0", row, "##value"}); }

// The pump of a balloon is seen without scrolling, and also when another scene was open before.
TEST(ForcesPanel, IsOpenAndInSightWhereASceneHasForces) {
  for (const char* first : {"balloon", "two_masses"}) {
    GuiFixture gui(shipped_scene(first));
    gui.app().handle(Request(OpenFile{find_scene("balloon")}));
    gui.app().wait_for_file_task();
    gui.frames(4);
    EXPECT_GT(find_slider(gui, "pressure").y, 0.0) << first;
    EXPECT_LT(find_slider(gui, "pressure").y, 800.0) << first;
  }
}

TEST(ForcesPanel, OfAFlatSceneHasNoZ) {
  Scene scene = shipped_scene("two_masses");
  scene.system.forces = {{find_force_term("wind"), true, default_values(*find_force_term("wind"))}};
  GuiFixture gui(std::move(scene));
  ASSERT_EQ(gui.system().dimensions, 2);
  EXPECT_NE(gui.text().find("Wind x"), std::string::npos);
  EXPECT_EQ(gui.text().find("Wind z"), std::string::npos);
}

TEST(ForcesPanel, ARightClickResetsToTheValueOfTheScene) {
  GuiFixture gui(shipped_scene("balloon"));
  const double opened = gui.system().forces[0].values[0];
  ASSERT_NE(opened, find_force_term("pressure")->numbers[0].default_value);
  SetForces set{gui.system().forces};
  set.forces[0].values[0] = 0.3 * opened;
  gui.app().handle(Request(Edit{set}));
  gui.frames(2);
  ASSERT_EQ(gui.system().forces[0].values[0], 0.3 * opened);
  gui.click(find_slider(gui, "pressure"), Button::Right);
  gui.frames(2);
  EXPECT_EQ(gui.system().forces[0].values[0], opened);
}

// What has leaked stays away, and the leak acts from the time of the edit on; undo restores all of it.
TEST(ForcesPanel, ALeakThatIsChangedInARunActsFromThenOn) {
  Scene scene = shipped_scene("balloon");
  scene.system.forces[0].values[3] = 0.5;
  GuiFixture gui(std::move(scene));
  gui.app().handle(Request(Control(RunTo{0.2})));
  EXPECT_TRUE(gui.wait_until([&] { return !(gui.status().snapshot->state.time < 0.2 - 1e-9); }));
  const Force before = gui.system().forces[0];
  SetForces set{gui.system().forces};
  set.forces[0].values[3] = 2.0;
  gui.app().handle(Request(Edit{set}));
  gui.frames(2);
  const double time = gui.status().snapshot->state.time;
  gui.click(gui.find("side", {"pressure 0", "leak", "##value"}), Button::Right);
  gui.frames(2);
  const Force& after = gui.system().forces[0];
  EXPECT_EQ(after.values[3], 0.5);
  EXPECT_EQ(after.values[4], time);
  EXPECT_NEAR(after.values[0], before.values[0] * std::exp(-2.0 * time), 1e-12 * before.values[0]);
  gui.key(letter('Z'), {.control = true});
  EXPECT_EQ(gui.system().forces[0], set.forces[0]);
}

TEST(ForcesPanel, TheRestShapeOfBendingIsAChoiceThatIsUndone) {
  GuiFixture gui(shipped_scene("paper"));
  gui.click(gui.find("side", {"bending 0", "rest", "##choice"}));
  gui.frames(2);
  gui.click(gui.find("##Combo_00", {"As built"}));
  gui.frames(2);
  EXPECT_EQ(gui.system().forces[0].values[2], 1.0);
  gui.key(letter('Z'), {.control = true});
  EXPECT_EQ(gui.system().forces[0].values[2], 0.0);
}

}  // namespace
}  // namespace hooke
