// The window program without a window: keys, camera, documents.
#include "app/app.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <thread>

#include "app/document/files.h"
#include "draw/view.h"
#include "formats/scene_file.h"
#include "support/gui_trial.h"
#include "support/scratch_folder.h"
#include "support/trial.h"

namespace hooke {
namespace {

constexpr Modifiers control{.control = true}, control_shift{.control = true, .shift = true};

Scene hanging(int dimensions = 2) {
  Trial trial;
  const PointId nail = trial.nail({0.0, 0.5, 0.0}), other = trial.nail({0.5, 0.5, 0.0}), bob = trial.add({0.2, 0.0, 0.0});
  trial.join(nail, bob, 100.0, 0.5);
  trial.join(other, bob, 100.0, 0.5);
  Scene scene;
  scene.name = "Hanging";
  scene.system = trial.system;
  scene.system.dimensions = dimensions;
  scene.state = trial.state;
  return scene;
}

TEST(Keys, SelectTheTools) {
  GuiTrial gui(hanging());
  for (const ToolRow& row : tools()) {
    const Shortcut& shortcut = shortcut_of(row.action);
    gui.key(shortcut.key, shortcut.modifiers);
    EXPECT_EQ(gui.app().tool(), row.action);
  }
}

TEST(Keys, RunPauseStepAndGoBackToStart) {
  GuiTrial gui(hanging());
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
  GuiTrial gui(hanging());
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
  GuiTrial gui(hanging());
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
  GuiTrial gui(hanging());
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
  for (int i = 0; i < 50 && (gui.status().run.running || gui.status().run.frames == 0); ++i) gui.frame();
  EXPECT_NEAR(gui.status().snapshot->state.time, 2.0, 1.0 / 60.0);
  EXPECT_FALSE(gui.status().run.running);
}

TEST(Recordings, AreStartedByAKeyAndReplayWithTheSameBits) {
  const ScratchFolder scratch;
  Scene scene = hanging();
  save_scene(scene, scratch.folder / "net.json");
  GuiTrial gui(scene, scratch.folder / "net.json");
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
  for (int i = 0; i < 2000 && (gui.status().run.running || gui.status().run.frames == 0); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    gui.frame();
  }
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
  GuiTrial gui(hanging());
  gui.key(letter('P'));
  gui.app().resize({1280.0, 800.0}, 1.0);
  for (int frame = 0; frame < 5; ++frame) gui.key(Key::Period);
  const TraceTable& table = *gui.status().timeline.traces;
  ASSERT_EQ(table.traces.size(), 4u);
  EXPECT_EQ(table.times.size(), 6u);
  for (const char* word : {"kinetic", "gravitational", "[J]"}) EXPECT_NE(gui.words().find(word), std::string::npos) << word;
  // the values at the mouse are shown
  const Rect& plots = gui.app().layout().plots;
  ASSERT_GT(plots.height, 100.0);
  gui.move({plots.x + 0.6 * plots.width, plots.y + 0.5 * plots.height});
  EXPECT_NE(gui.words().find("total = "), std::string::npos);
  gui.key(letter('P'));
  gui.app().resize({1280.0, 800.0}, 1.0);
  EXPECT_EQ(gui.app().layout().plots.height, 0.0);
}

TEST(Keys, TabHidesThePanels) {
  GuiTrial gui(hanging());
  const Rect before = gui.app().layout().scene;
  gui.key(Key::Tab);
  gui.app().resize({1280.0, 800.0}, 1.0);
  EXPECT_EQ(gui.app().layout().scene.width, 1280.0);
  gui.frame();
  EXPECT_EQ(gui.words().find("Substeps"), std::string::npos);
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
  GuiTrial gui(hanging());
  const ImU32 dark = palette::panel;
  for (int look = 0; look < 2; ++look) {
    for (const ImU32 words : {palette::text, palette::dim, palette::accent, palette::good, palette::warning, palette::bad})
      for (const ImU32 ground : {palette::panel, palette::box}) EXPECT_GE(contrast(words, ground), 4.5) << look;
    gui.key(letter('L'), {.control = true, .shift = true});
  }
  EXPECT_EQ(palette::panel, dark);
}

TEST(Keys, ReleaseEveryNailAndUndoNailsThemAgain) {
  GuiTrial gui(hanging());
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
  GuiTrial gui(hanging());
  gui.key(Key::Up);
  gui.key(Key::Up, {}, true);
  gui.key(Key::Up, {}, true);
  EXPECT_NEAR(gui.system().springs()[0].stiffness, 133.1, 1e-9);
  EXPECT_NE(gui.app().panels().toast.find("133.1"), std::string::npos);
  gui.key(letter('Z'), control);
  EXPECT_EQ(gui.system().springs()[0].stiffness, 100.0);
}

TEST(Keys, AHeldKeyDoesNotRepeatOneShotActions) {
  GuiTrial gui(hanging());
  gui.key(Key::Space);
  gui.key(Key::Space, {}, true);
  EXPECT_TRUE(gui.status().run.running);
  gui.key(Key::F1);
  gui.key(Key::F1, {}, true);
  EXPECT_TRUE(gui.app().panels().keys_shown);
}

TEST(Keys, SelectAllAndDelete) {
  GuiTrial gui(hanging());
  gui.key(letter('A'), control);
  EXPECT_EQ(gui.app().selection().points.size(), 3u);
  gui.key(Key::Delete);
  EXPECT_EQ(gui.system().point_count(), 0);
  EXPECT_TRUE(gui.app().selection().empty());
  gui.key(letter('Z'), control);
  EXPECT_EQ(gui.system().spring_count(), 2);
}

TEST(Keys, EscLeavesTheInnermostModeAndNeverQuits) {
  GuiTrial gui(hanging());
  gui.key(letter('A'), control);
  gui.key(letter('N'));
  gui.key(Key::F1);
  gui.key(Key::Escape);
  EXPECT_FALSE(gui.app().panels().keys_shown);
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
  GuiTrial gui(hanging());
  gui.key(Key::Space);
  gui.key(letter('A'));
  gui.click(gui.seen({0.25, 0.4, 0.0}));
  EXPECT_EQ(gui.system().point_count(), 4);
  EXPECT_TRUE(gui.status().run.running);
}

TEST(Mouse, TwoClicksWithinOneFrameBothCount) {
  GuiTrial gui(hanging());
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
  GuiTrial gui(hanging());
  gui.key(letter('A'));
  const Rect& side = gui.app().layout().side;
  gui.click({side.x + 20.0, side.y + 500.0});
  EXPECT_EQ(gui.system().point_count(), 3);
}

TEST(Camera, OrbitsPansAndZoomsToTheCursor) {
  GuiTrial gui(hanging(3));
  const Vec3 back = gui.app().camera().back, target = gui.app().camera().target;
  gui.drag({400.0, 400.0}, {480.0, 420.0}, Button::Right);
  EXPECT_GT(glm::distance(gui.app().camera().back, back), 0.1);
  EXPECT_EQ(gui.app().camera().target, target);
  gui.drag({400.0, 400.0}, {480.0, 420.0}, Button::Middle, {.shift = true});
  EXPECT_GT(glm::distance(gui.app().camera().target, target), 0.01);

  const glm::dvec2 before = gui.seen({0.2, 0.0, 0.0});
  const double distance = gui.app().camera().distance;
  gui.move(before);
  gui.app().handle(Scroll{3.0, before});
  EXPECT_LT(gui.app().camera().distance, distance);
  EXPECT_LT(glm::distance(gui.seen({0.2, 0.0, 0.0}), before), 40.0);
  gui.key(Key::Home);
  const glm::dvec2 home = gui.seen({0.2, 0.2, 0.0});
  EXPECT_TRUE(gui.app().layout().scene.contains(home.x, home.y));
}

TEST(Camera, StaysPerpendicularToAFlatScene) {
  GuiTrial gui(hanging());
  const Vec3 back = gui.app().camera().back, target = gui.app().camera().target;
  gui.drag({400.0, 400.0}, {480.0, 420.0}, Button::Right);
  EXPECT_EQ(gui.app().camera().back, back);
  EXPECT_NE(gui.app().camera().target, target);
}

TEST(Camera, LooksAlongTheAxesAndFromTheOppositeSideOnRepetition) {
  GuiTrial gui(hanging(3));
  const auto from = [&](char key) {
    gui.key(letter(key));
    return gui.app().camera().back;
  };
  EXPECT_LT(glm::distance(from('1'), {0.0, 0.0, 1.0}), 1e-12);
  EXPECT_LT(glm::distance(from('1'), {0.0, 0.0, -1.0}), 1e-12);
  EXPECT_LT(glm::distance(gui.app().camera().up, {0.0, 1.0, 0.0}), 1e-12);
  EXPECT_LT(glm::distance(from('3'), {1.0, 0.0, 0.0}), 1e-12);
  EXPECT_LT(glm::distance(from('7'), {0.0, 1.0, 0.0}), 1e-12);
  // seen from above, the front is at the bottom
  EXPECT_LT(glm::distance(gui.app().camera().up, {0.0, 0.0, -1.0}), 1e-12);
  EXPECT_LT(glm::distance(from('7'), {0.0, -1.0, 0.0}), 1e-12);
  EXPECT_LT(glm::distance(gui.app().camera().up, {0.0, 0.0, 1.0}), 1e-12);
  gui.key(letter('5'));
  EXPECT_TRUE(gui.app().camera().orthographic);
  gui.key(letter('5'));
  EXPECT_FALSE(gui.app().camera().orthographic);
  // then it orbits as before
  gui.drag({400.0, 400.0}, {480.0, 420.0}, Button::Right);
  EXPECT_NEAR(glm::length(gui.app().camera().up), 1.0, 1e-12);
  EXPECT_NEAR(glm::dot(gui.app().camera().up, gui.app().camera().back), 0.0, 1e-12);
}

TEST(Camera, AClickOnAnAxisLooksAlongIt) {
  {
    GuiTrial flat(hanging(2));
    flat.frames(2);
    EXPECT_EQ(ImGui::FindWindowByName("axes"), nullptr);
  }
  GuiTrial gui(hanging(3));
  gui.frames(2);
  const ImGuiWindow* axes = ImGui::FindWindowByName("axes");
  ASSERT_NE(axes, nullptr);
  const Camera camera = gui.app().camera();
  const Vec3 right = glm::cross(camera.up, camera.back);
  const glm::dvec2 center(axes->Pos.x + 0.5 * axes->Size.x, axes->Pos.y + 0.5 * axes->Size.y);
  gui.click(center + 31.0 * glm::dvec2(right.x, -camera.up.x));
  EXPECT_LT(glm::distance(gui.app().camera().back, {1.0, 0.0, 0.0}), 1e-12);
  EXPECT_TRUE(gui.app().selection().empty());
}

TEST(Camera, IsCopiedAndPastedAsText) {
  GuiTrial gui(hanging(3));
  gui.drag({400.0, 400.0}, {480.0, 420.0}, Button::Right);
  gui.key(letter('5'));
  const Camera camera = gui.app().camera();
  gui.key(letter('C'), control_shift);
  gui.key(letter('1'));
  gui.key(letter('5'));
  gui.key(letter('V'), control_shift);
  const Camera& pasted = gui.app().camera();
  EXPECT_LT(glm::distance(pasted.eye(), camera.eye()), 1e-12);
  EXPECT_LT(glm::distance(pasted.target, camera.target), 1e-12);
  EXPECT_TRUE(pasted.orthographic);
  gui.app().use({.put = nullptr, .take = [] { return std::string("1,2,3"); }});
  gui.key(letter('V'), control_shift);
  EXPECT_EQ(gui.app().panels().toast, "The clipboard contains no camera");
  EXPECT_LT(glm::distance(gui.app().camera().eye(), camera.eye()), 1e-12);
}

TEST(Documents, CanBeSavedAtATypedPathAndReopened) {
  const ScratchFolder scratch;
  GuiTrial gui(hanging());
  EXPECT_EQ(gui.app().title(), "Hooke - Hanging");
  gui.key(letter('R'));
  EXPECT_EQ(gui.app().title(), "Hooke - Hanging*");
  gui.key(letter('S'), control);
  ASSERT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::Save);
  gui.type((scratch.folder / "mine").string());
  gui.key(Key::Enter);
  EXPECT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::None);
  EXPECT_EQ(gui.app().title(), "Hooke - mine");
  const Scene saved = load_scene(scratch.folder / "mine.json").scene;
  EXPECT_EQ(saved.system.point_count(), 3);
  EXPECT_FALSE(saved.system.points()[0].nailed);

  gui.key(letter('N'), control);
  EXPECT_EQ(gui.system().point_count(), 0);
  gui.key(letter('O'), control);
  gui.type((scratch.folder / "mine.json").string());
  gui.key(Key::Enter);
  EXPECT_EQ(gui.system().point_count(), 3);
  EXPECT_EQ(gui.app().title(), "Hooke - mine");
  // from now on Save asks for no name
  gui.key(letter('R'));
  gui.key(letter('A'), control);
  gui.key(Key::Delete);
  gui.key(letter('S'), control);
  EXPECT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::None);
  EXPECT_EQ(load_scene(scratch.folder / "mine.json").scene.system.point_count(), 0);
}

TEST(Documents, AShippedSceneIsNeverOverwritten) {
  const ShippedScene& shipped = shipped_scenes().front();
  GuiTrial gui(load_scene(shipped.file).scene, shipped.file);
  gui.key(letter('S'), control);
  EXPECT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::Save);
  EXPECT_NE(gui.app().panels().dialog.typed, shipped.file.string());
}

TEST(Documents, ARefusedFileIsNamedAndTheOpenDocumentIsUnchanged) {
  const ScratchFolder scratch;
  std::ofstream(scratch.folder / "bad.json") << R"({"hooke": 1, "points": [{"position": [0, 0, 0], "mass": -1}]})";
  GuiTrial gui(hanging());
  gui.key(letter('O'), control);
  gui.type((scratch.folder / "bad.json").string());
  gui.key(Key::Enter);
  ASSERT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::Message);
  const std::string words = gui.words();
  for (const char* part : {"bad.json", "mass", "-1"}) EXPECT_NE(words.find(part), std::string::npos) << part;
  gui.key(Key::Enter);
  EXPECT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::None);
  EXPECT_EQ(gui.system().point_count(), 3);
  EXPECT_EQ(gui.status().document->name, "Hanging");
}

TEST(Documents, AFailedSaveIsReportedAndTheDocumentStaysModified) {
  GuiTrial gui(hanging());
  gui.key(letter('R'));
  gui.key(letter('S'), control_shift);
  gui.type("/nowhere/at/all.json");
  gui.key(Key::Enter);
  ASSERT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::Message);
  EXPECT_NE(gui.words().find("/nowhere/at/all.json"), std::string::npos);
  EXPECT_EQ(gui.app().title(), "Hooke - Hanging*");
}

// A sheet of two faces, and a picture in the same folder.
struct Draped {
  ScratchFolder scratch;
  std::filesystem::path file = scratch.folder / "draped.json";
  Draped() {
    std::ofstream(file) << R"({"hooke": 1, "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0],
      "down": [0, -1, 0], "points": [2, 2], "stiffness": 10}], "view": {"springs": false}})";
    write_png(Image{1, 1, {9, 9, 9}}, scratch.folder / "mine.png");
  }
};

TEST(Textures, AreChosenSavedAndUndone) {
  const Draped draped;
  GuiTrial gui(load_scene(draped.file).scene, draped.file);
  EXPECT_FALSE(gui.app().view_options().springs);
  gui.app().handle(FileDrop{draped.scratch.folder / "mine.png"});
  EXPECT_EQ(gui.status().document->view.texture, "mine.png");
  ASSERT_TRUE(gui.app().view_options().cloth_texture.picture);
  EXPECT_FALSE(gui.app().view_options().strain_colors);  // they would hide the texture
  EXPECT_EQ(gui.status().history.undo_name, "set the texture");

  gui.app().panels().view.points = false;
  gui.key(letter('S'), control);
  const LoadedScene saved = load_scene(draped.file);
  EXPECT_TRUE(saved.warnings.empty());
  EXPECT_EQ(saved.scene.view, (ViewSettings{.springs = false, .points = false, .strain_colors = false, .texture = "mine.png"}));

  gui.key(letter('Z'), control);
  EXPECT_EQ(gui.status().document->view.texture, "");
  EXPECT_FALSE(gui.app().view_options().cloth_texture.picture);
}

TEST(Textures, OutsideTheFolderAreRefusedWithTheReason) {
  const Draped draped;
  GuiTrial gui(load_scene(draped.file).scene, draped.file);
  gui.app().handle(FileDrop{draped.scratch.folder.parent_path() / "other.png"});
  ASSERT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::Message);
  EXPECT_NE(gui.app().panels().dialog.text.find("\"../other.png\": must be in the folder of the scene, " + draped.scratch.folder.string()),
            std::string::npos);
  gui.key(Key::Enter);
  EXPECT_EQ(gui.status().document->view.texture, "");
}

TEST(Textures, OfAnUnsavedDocumentRequireSavingItFirst) {
  const Draped draped;
  GuiTrial gui(hanging());
  gui.app().handle(FileDrop{draped.scratch.folder / "mine.png"});
  EXPECT_NE(gui.app().panels().dialog.text.find("save the scene there first"), std::string::npos);
}

TEST(Documents, AskBeforeChangesAreLost) {
  const ScratchFolder scratch;
  GuiTrial gui(hanging());
  gui.key(letter('R'));
  gui.app().handle(CloseRequest{});
  gui.frames(2);
  EXPECT_FALSE(gui.app().is_finished());
  ASSERT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::Unsaved);
  gui.key(Key::Escape);
  EXPECT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::None);
  EXPECT_FALSE(gui.app().is_finished());

  // saves first, to a path that must be typed, then quits
  gui.key(letter('Q'), control);
  gui.key(Key::Enter);
  ASSERT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::Save);
  gui.frames(2);  // the dialog appears
  gui.type((scratch.folder / "kept.json").string());
  gui.key(Key::Enter);
  EXPECT_TRUE(gui.app().is_finished());
  EXPECT_TRUE(std::filesystem::exists(scratch.folder / "kept.json"));
}

TEST(Documents, QuitAtOnceWithoutUnsavedChanges) {
  GuiTrial gui(hanging());
  gui.key(letter('Q'), control);
  EXPECT_TRUE(gui.app().is_finished());
}

TEST(Dialogs, ReceiveAllKeysWhileOpen) {
  GuiTrial gui(hanging());
  gui.key(letter('O'), control);
  gui.key(letter('R'));
  gui.key(Key::Space);
  EXPECT_TRUE(gui.system().points()[0].nailed);
  EXPECT_FALSE(gui.status().run.running);
  gui.key(Key::Escape);
  EXPECT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::None);
  gui.key(letter('R'));
  EXPECT_FALSE(gui.system().points()[0].nailed);
}

TEST(Dialogs, AcceptATypedPath) {
  GuiTrial gui(hanging());
  gui.key(letter('O'), control);
  gui.frames(2);
  gui.type("some/path.json");
  EXPECT_EQ(gui.app().panels().dialog.typed, "some/path.json");
}

TEST(Paths, AreInterpretedAsTyped) {
  ::setenv("HOME", "/home/somebody", 1);
  EXPECT_EQ(typed_path("~/net"), "/home/somebody/net.json");
  EXPECT_EQ(typed_path("/a/../b/net.xsp"), "/b/net.xsp");
  EXPECT_EQ(typed_path("net"), std::filesystem::current_path() / "net.json");
}

}  // namespace
}  // namespace hooke
