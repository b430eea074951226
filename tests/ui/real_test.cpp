// "Is this real?": the check of the result, ghosts, the stretch of springs and the lesson about them.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "formats/scene_file.h"
#include "sim/methods/integrator.h"
#include "support/two_springs.h"

namespace hooke {
namespace {

void run_for(GuiFixture& gui, double seconds) {
  const double until = gui.status().snapshot->state.time + seconds;
  if (!gui.status().run.running) gui.key(Key::Space);
  while (gui.status().snapshot->state.time < until && gui.status().diagnosis.message.empty()) gui.frame();
}

TEST(ResultCheckPanel, ShowsASentenceAndATable) {
  GuiFixture gui(two_springs());
  gui.key(letter('K'), {.control = true, .shift = true});
  ASSERT_TRUE(eventually_shows(gui, "Maximum strain")) << gui.text();
  const std::string words = gui.text();
  for (const char* word : {"Check this result", "ndependent of the step", "no sheet or rope to refine", "half the step", "Energy change"})
    EXPECT_NE(words.find(word), std::string::npos) << word << " in " << words;
  EXPECT_EQ(words.find("twice the resolution"), std::string::npos);
}

TEST(GhostPanel, OtherSettingsRunBesideTheRunAndAreDrawn) {
  GuiFixture gui(two_springs());
  gui.key(letter('B'), {.control = true, .shift = true});
  run_for(gui, 0.5);
  gui.key(Key::Space);
  gui.frames(3);
  const auto& ghosts = gui.status().companions;
  ASSERT_EQ(ghosts.list.size(), 1u);
  EXPECT_TRUE(ghosts.list[0].positions);
  EXPECT_EQ(gui.app().marks().ghost_networks.size(), 1u);
  EXPECT_EQ(gui.app().marks().ghost_networks[0].color, to_color(ghost_color(0)));
  EXPECT_NE(gui.text().find("Compare side by side"), std::string::npos);

  gui.click(gui.find("ghosts", {"Add"}));
  gui.frames(3);
  EXPECT_EQ(gui.status().companions.list.size(), 2u);
  gui.click(gui.find("ghosts", {"Close"}));
  gui.frames(3);
  EXPECT_TRUE(gui.status().companions.list.empty());
  EXPECT_TRUE(gui.app().marks().ghost_networks.empty());
}

TEST(GhostPanel, AfterAnEditGhostsStartAgainWithTheEditedScene) {
  GuiFixture gui(two_springs());
  gui.key(letter('G'), {.control = true, .shift = true});
  run_for(gui, 0.3);
  gui.app().handle(Request(Edit{SetParameter{find_parameter("stiffness"), 250.0}}));
  run_for(gui, 0.3);
  gui.frames(3);
  const auto& ghosts = gui.status().companions;
  ASSERT_EQ(ghosts.list.size(), 1u);
  EXPECT_GT(ghosts.since, 0.25);
  EXPECT_LT(ghosts.list[0].distance, 1e-3);
}

TEST(StretchOfSprings, IsExplainedBelowTheirProperties) {
  GuiFixture gui(two_springs());
  gui.key(letter('A'), {.control = true});
  gui.frames(3);
  gui.app().handle(Request(ExplainStretch{}));
  EXPECT_TRUE(eventually_shows(gui, "Step error")) << gui.text();
}

TEST(Lesson, ChecksOffEachStepWhenItIsDoneAndNotBefore) {
  GuiFixture gui(load_scene(find_scene("how_wrong")).scene);
  const auto done = [&] {
    gui.frames(2);
    return gui.app().panels().side.lesson_steps_done;
  };
  EXPECT_EQ(done(), 0u);
  run_for(gui, 0.2);
  EXPECT_EQ(done(), 0u);
  gui.key(letter('M'));
  EXPECT_EQ(done(), 1u);
  for (int i = 0; i < 600 && done() == 1u; ++i) run_for(gui, 0.1);
  EXPECT_EQ(done(), 3u);
  gui.key(letter('R'), {.control = true});
  gui.app().handle(Request(Edit{SetParameter{find_parameter("substeps"), 40.0}}));
  for (int i = 0; i < 100 && done() == 3u; ++i) run_for(gui, 0.1);
  EXPECT_EQ(done(), 7u);
  gui.key(letter('R'), {.control = true});
  gui.key(letter('G'), {.control = true, .shift = true});
  for (int i = 0; i < 600 && done() == 7u; ++i) run_for(gui, 0.1);
  EXPECT_EQ(done(), 15u);
  gui.key(Key::Space);
  gui.key(letter('M'), {.control = true, .shift = true});
  EXPECT_EQ(done(), 15u);
  EXPECT_TRUE(gui.wait_until([&] { return gui.app().panel_input({}).results.comparison.result != nullptr; }));
  const auto compared = gui.app().panel_input({}).results.comparison.result;
  ASSERT_TRUE(compared && !compared->record.rows.empty());
  EXPECT_EQ(done(), 15u);
  const Row& row = compared->record.rows.front();
  gui.app().handle(Request(Edit{SetIntegrator{find_integrator(row.method)}}));
  EXPECT_EQ(done(), 15u);
  gui.app().handle(Request(Edit{SetParameter{find_parameter("substeps"), static_cast<double>(substeps_of(row, 60.0).value())}}));
  EXPECT_EQ(done(), 31u);
}

TEST(ResultCheckPanel, OfThePreviousSceneIsNotShownForTheNextOne) {
  GuiFixture gui(two_springs());
  gui.key(letter('K'), {.control = true, .shift = true});
  ASSERT_TRUE(eventually_shows(gui, "Maximum strain")) << gui.text();
  gui.app().handle(Request(Action::NewFlatScene));
  gui.frames(3);
  EXPECT_FALSE(gui.app().panel_input({}).results.result_check.result);
}

TEST(GhostPanel, GhostsStopWhenAnotherPanelTakesTheirPlace) {
  GuiFixture gui(two_springs());
  gui.key(letter('B'), {.control = true, .shift = true});
  run_for(gui, 0.1);
  ASSERT_EQ(gui.status().companions.list.size(), 1u);
  gui.key(letter('K'), {.control = true, .shift = true});
  gui.frames(3);
  EXPECT_TRUE(gui.status().companions.list.empty());
  EXPECT_TRUE(gui.app().marks().ghost_networks.empty());
}

}  // namespace
}  // namespace hooke
