// The window program without a window: keys, mouse, timeline, plots, recordings.
#include "app/app.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "app/document/files.h"
#include "formats/scene_file.h"
#include "support/gui_fixture.h"
#include "support/hanging_scene.h"
#include "support/scratch_folder.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

TEST(Keys, SelectTheTools) {
  GuiFixture gui(hanging());
  for (const ToolRow& row : tools()) {
    const Shortcut& shortcut = shortcut_of(row.action);
    gui.key(shortcut.key, shortcut.modifiers);
    EXPECT_EQ(gui.app().tool(), row.action);
  }
}

TEST(Keys, RunPauseStepAndGoBackToStart) {
  GuiFixture gui(hanging());
  gui.key(Key::Period);
  EXPECT_EQ(gui.status().run.frames, 1);
  EXPECT_FALSE(gui.status().run.running);
  gui.key(Key::Space);
  EXPECT_TRUE(gui.status().run.running);
  gui.key(Key::Space);
  EXPECT_FALSE(gui.status().run.running);
  gui.key(letter('R'), control);
  EXPECT_EQ(gui.status().snapshot->state.position[2], (Vec3{0.2, 0.0, 0.0}));
  EXPECT_EQ(gui.status().snapshot->state.time, 0.0);
}

TEST(Keys, StepBackAndSetTheSpeed) {
  GuiFixture gui(hanging());
  gui.key(Key::Period);
  const double time = gui.status().snapshot->state.time;
  gui.key(Key::Period);
  gui.key(letter(','));
  EXPECT_EQ(gui.status().snapshot->state.time, time);
  gui.key(letter('['));
  EXPECT_EQ(gui.status().snapshot->settings.speed, 0.5);
  gui.key(letter(']'));
  EXPECT_EQ(gui.status().snapshot->settings.speed, 1.0);
}

TEST(TimelineStrip, IsDraggedToAFrameAndBackInOneUndoStep) {
  GuiFixture gui(hanging());
  for (int frame = 0; frame < 20; ++frame) gui.key(Key::Period);
  const double last = gui.status().snapshot->state.time;
  const Rect& strip = gui.app().layout().timeline;
  const double y = strip.y + 0.5 * strip.height;
  gui.drag({strip.x + 0.5 * strip.width, y}, {strip.x + 0.2 * strip.width, y});
  const double there = gui.status().snapshot->state.time;
  EXPECT_GT(there, 0.0);
  EXPECT_LT(there, 0.6 * last);
  EXPECT_EQ(gui.status().timeline.end, last);
  gui.key(letter('Z'), control);
  EXPECT_EQ(gui.status().snapshot->state.time, last);
}

TEST(TimelineStrip, RunsToATypedTime) {
  GuiFixture gui(hanging());
  gui.click(gui.find("timeline", {"##run_to"}));
  ASSERT_TRUE(ImGui::GetIO().WantTextInput);
  ImGui::GetIO().KeyCtrl = true;
  ImGui::GetIO().KeysDown[ImGuiKey_A] = true;
  gui.frame();
  ImGui::GetIO().KeyCtrl = ImGui::GetIO().KeysDown[ImGuiKey_A] = false;
  gui.frame();
  gui.type("2");
  ImGui::GetIO().KeysDown[ImGuiKey_Enter] = true;
  gui.frame();
  ImGui::GetIO().KeysDown[ImGuiKey_Enter] = false;
  EXPECT_TRUE(gui.wait_for_end_of_run());
  EXPECT_NEAR(gui.status().snapshot->state.time, 2.0, 1.0 / 60.0);
  EXPECT_FALSE(gui.status().run.running);
}

TEST(Recordings, AreStartedByAKeyAndReplayWithTheSameBits) {
  const ScratchFolder scratch;
  Scene scene = hanging();
  save_scene(scene, scratch.folder / "net.json");
  GuiFixture gui(scene, scratch.folder / "net.json");
  gui.key(letter('R'), {.control = true, .shift = true});
  for (int frame = 0; frame < 5; ++frame) gui.key(Key::Period);
  gui.key(letter('R'));
  for (int frame = 0; frame < 5; ++frame) gui.key(Key::Period);
  const State end = gui.status().snapshot->state;
  EXPECT_NE(gui.status().recording.file, "");
  gui.key(letter('R'), {.control = true, .shift = true});
  EXPECT_EQ(gui.status().recording.file, "");
  ASSERT_TRUE(std::filesystem::exists(scratch.folder / "net.hookelog"));

  gui.app().document().play(std::make_shared<const Recording>(read_recording(scratch.folder / "net.hookelog")));
  EXPECT_EQ(gui.status().snapshot->state.position, scene.state.position);
  // in real time, ten frames take a sixth of a second
  EXPECT_TRUE(gui.wait_for_end_of_run());
  EXPECT_EQ(gui.status().recording.difference, "");
  EXPECT_EQ(gui.status().snapshot->state.position, end.position);
  EXPECT_EQ(gui.status().snapshot->state.velocity, end.velocity);
}

TEST(FreeNames, ComeFromTheDocumentAndReplaceNoFile) {
  const ScratchFolder scratch;
  EXPECT_EQ(free_name(scratch.folder, "net", ".png"), scratch.folder / "net.png");
  std::ofstream(scratch.folder / "net.png") << "mine";
  EXPECT_EQ(free_name(scratch.folder, "net", ".png"), scratch.folder / "net 2.png");
}

TEST(Plots, ShowTheEnergiesAndTheChosenQuantities) {
  GuiFixture gui(hanging());
  gui.key(letter('P'));
  gui.app().resize({1280.0, 800.0}, 1.0);
  for (int frame = 0; frame < 5; ++frame) gui.key(Key::Period);
  const TraceTable& table = *gui.status().timeline.traces;
  ASSERT_EQ(table.traces.size(), 4u);
  EXPECT_EQ(table.times.size(), 6u);
  for (const char* word : {"kinetic", "gravitational", "[J]"}) EXPECT_NE(gui.text().find(word), std::string::npos) << word;
  // the values at the mouse are shown
  const Rect& plots = gui.app().layout().plots;
  ASSERT_GT(plots.height, 100.0);
  gui.move({plots.x + 0.6 * plots.width, plots.y + 0.5 * plots.height});
  EXPECT_NE(gui.text().find("total = "), std::string::npos);
  gui.key(letter('P'));
  gui.app().resize({1280.0, 800.0}, 1.0);
  EXPECT_EQ(gui.app().layout().plots.height, 0.0);
}

TEST(Keys, TabHidesThePanels) {
  GuiFixture gui(hanging());
  const Rect before = gui.app().layout().scene;
  gui.key(Key::Tab);
  gui.app().resize({1280.0, 800.0}, 1.0);
  EXPECT_EQ(gui.app().layout().scene.width, 1280.0);
  gui.frame();
  EXPECT_EQ(gui.text().find("Substeps"), std::string::npos);
  gui.key(Key::Tab);
  gui.app().resize({1280.0, 800.0}, 1.0);
  EXPECT_EQ(gui.app().layout().scene, before);
}

// The contrast ratio of two colors (WCAG 2).
double contrast(ImU32 a, ImU32 b) {
  const auto luminance = [](ImU32 color) {
    double sum = 0.0;
    for (const auto& [shift, weight] : {std::pair{IM_COL32_R_SHIFT, 0.2126}, {IM_COL32_G_SHIFT, 0.7152}, {IM_COL32_B_SHIFT, 0.0722}}) {
      const double channel = static_cast<double>((color >> shift) & 255u) / 255.0;
      sum += weight * (channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4));
    }
    return sum + 0.05;
  };
  return std::max(luminance(a), luminance(b)) / std::min(luminance(a), luminance(b));
}

TEST(Themes, AreReadableDarkAndLight) {
  GuiFixture gui(hanging());
  const ImU32 dark = palette::panel;
  for (int look = 0; look < 2; ++look) {
    for (const ImU32 words : {palette::text, palette::dim, palette::accent, palette::good, palette::warning, palette::bad})
      for (const ImU32 ground : {palette::panel, palette::box}) EXPECT_GE(contrast(words, ground), 4.5) << look;
    gui.key(letter('L'), {.control = true, .shift = true});
  }
  EXPECT_EQ(palette::panel, dark);
}

TEST(Keys, ReleaseEveryNailAndUndoNailsThemAgain) {
  GuiFixture gui(hanging());
  gui.key(letter('R'));
  for (const Point& point : gui.system().points()) EXPECT_FALSE(point.nailed);
  gui.key(letter('Z'), control);
  EXPECT_TRUE(gui.system().points()[0].nailed);
  EXPECT_TRUE(gui.system().points()[1].nailed);
  gui.key(letter('Z'), control_shift);
  EXPECT_FALSE(gui.system().points()[0].nailed);
  gui.key(letter('Z'), control);
  gui.key(letter('Y'), control);
  EXPECT_FALSE(gui.system().points()[1].nailed);
}

TEST(Keys, AHeldArrowIsOneUndoStepAndShowsTheValue) {
  GuiFixture gui(hanging());
  gui.key(Key::Up);
  gui.key(Key::Up, {}, true);
  gui.key(Key::Up, {}, true);
  EXPECT_NEAR(gui.system().springs()[0].stiffness, 133.1, 1e-9);
  EXPECT_NE(gui.app().panels().messages.toast.find("133.1"), std::string::npos);
  gui.key(letter('Z'), control);
  EXPECT_EQ(gui.system().springs()[0].stiffness, 100.0);
}

TEST(Keys, QuickPressesOfTheKeysOfOneValueAreOneStepOfUndo) {
  GuiFixture gui(hanging());
  for (const Key key : {Key::Up, Key::Up, Key::Down, Key::Up}) gui.key(key);
  gui.key(Key::Right);
  EXPECT_EQ(gui.status().history.list->names.size(), 2u);
  EXPECT_EQ(gui.status().history.list->names[0], "stiffness of 2 springs to 121 N/m");
  EXPECT_EQ(gui.status().history.list->names[1], "set Substeps to 25");
  gui.key(letter('Z'), control);
  gui.key(letter('Z'), control);
  EXPECT_EQ(gui.system().springs()[0].stiffness, 100.0);
}

TEST(UnsavedChanges, AreNotAskedAboutAfterPlaying) {
  GuiFixture gui(hanging());
  gui.key(Key::Period);
  gui.key(letter('R'));
  gui.key(letter('R'), control);
  gui.key(letter('N'), control);
  EXPECT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::None);
}

TEST(UnsavedChanges, AreNamedWhereTheyWouldBeLost) {
  GuiFixture tuned(hanging());
  tuned.key(Key::Up);
  tuned.key(Key::Right);
  tuned.key(letter('N'), control);
  ASSERT_EQ(tuned.app().panels().dialog.kind, Dialog::Kind::Unsaved);
  EXPECT_EQ(tuned.app().panels().dialog.title, "Save changes to \"Hanging\"?");
  EXPECT_EQ(tuned.app().panels().dialog.text, "Not saved yet: set Substeps to 25, stiffness of 2 springs to 110 N/m.");
  tuned.key(Key::Escape);
  for (std::uint32_t i = 100; i < 103; ++i) tuned.app().handle(Request(Edit{Insert{.points = {{.point = {.id = PointId{i}}}}}}));
  tuned.key(letter('N'), control);
  EXPECT_EQ(tuned.app().panels().dialog.text,
            "Not saved yet: add 1 point (3 times), set Substeps to 25, stiffness of 2 springs to 110 N/m.");
}

TEST(Keys, SetTheStartAndResetTheParameters) {
  GuiFixture gui(hanging());
  gui.key(Key::Up);
  gui.key(Key::Period);
  const State there = gui.status().snapshot->state;
  gui.key(letter('T'), control_shift);
  gui.key(Key::Period);
  gui.key(letter('R'), control);
  EXPECT_EQ(gui.status().snapshot->state.position, there.position);
  EXPECT_DOUBLE_EQ(gui.system().springs()[0].stiffness, 110.0);
  gui.key(letter('D'), control_shift);
  EXPECT_EQ(gui.system().springs()[0].stiffness, 100.0);
}

TEST(Keys, AHeldKeyDoesNotRepeatOneShotActions) {
  GuiFixture gui(hanging());
  gui.key(Key::Space);
  gui.key(Key::Space, {}, true);
  EXPECT_TRUE(gui.status().run.running);
  gui.key(Key::F1);
  gui.key(Key::F1, {}, true);
  EXPECT_TRUE(gui.app().panels().shown.keys);
}

TEST(Keys, SelectAllAndDelete) {
  GuiFixture gui(hanging());
  gui.key(letter('A'), control);
  EXPECT_EQ(gui.app().selection().points.size(), 3u);
  gui.key(Key::Delete);
  EXPECT_EQ(gui.system().point_count(), 0);
  EXPECT_TRUE(gui.app().selection().empty());
  gui.key(letter('Z'), control);
  EXPECT_EQ(gui.system().spring_count(), 2);
}

TEST(Keys, EscLeavesTheInnermostModeAndNeverQuits) {
  GuiFixture gui(hanging());
  gui.key(letter('A'), control);
  gui.key(letter('N'));
  gui.key(Key::F1);
  gui.key(Key::Escape);
  EXPECT_FALSE(gui.app().panels().shown.keys);
  EXPECT_FALSE(gui.app().selection().empty());
  gui.key(Key::Escape);
  EXPECT_TRUE(gui.app().selection().empty());
  EXPECT_EQ(gui.app().tool(), Action::NailTool);
  gui.key(Key::Escape);
  EXPECT_EQ(gui.app().tool(), Action::SelectTool);
  gui.key(Key::Escape);
  EXPECT_FALSE(gui.app().is_finished());
}

TEST(Mouse, BuildsDuringARun) {
  GuiFixture gui(hanging());
  gui.key(Key::Space);
  gui.key(letter('A'));
  gui.click(gui.seen({0.25, 0.4, 0.0}));
  EXPECT_EQ(gui.system().point_count(), 4);
  EXPECT_TRUE(gui.status().run.running);
}

TEST(Mouse, TwoClicksWithinOneFrameBothCount) {
  GuiFixture gui(hanging());
  gui.key(letter('A'));
  const glm::dvec2 first = gui.seen({0.25, 0.4, 0.0}), second = gui.seen({0.4, 0.1, 0.0});
  for (const glm::dvec2& at : {first, second}) {
    gui.app().handle(ButtonPress{Button::Left, at, {}});
    gui.app().handle(ButtonRelease{Button::Left, at, {}});
  }
  gui.app().handle(KeyPress{letter('T'), {}, false});
  for (const glm::dvec2& at : {first, second}) {
    gui.app().handle(ButtonPress{Button::Left, at, {}});
    gui.app().handle(ButtonRelease{Button::Left, at, {}});
  }
  EXPECT_EQ(gui.system().point_count(), 5);
  EXPECT_EQ(gui.system().spring_count(), 3);
}

TEST(Mouse, APressOnAPanelDoesNotReachTheScene) {
  GuiFixture gui(hanging());
  gui.key(letter('A'));
  const Rect& side = gui.app().layout().side;
  gui.click({side.x + 20.0, side.y + 500.0});
  EXPECT_EQ(gui.system().point_count(), 3);
}

}  // namespace
}  // namespace hooke
