// Opening and saving documents, textures, and their dialogs.
#include "app/app.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/document/files.h"
#include "draw/view.h"
#include "formats/scene_file.h"
#include "scene/parameters.h"
#include "support/gui_fixture.h"
#include "support/hanging_scene.h"
#include "support/scratch_folder.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

TEST(Documents, CanBeSavedAtATypedPathAndReopened) {
  const ScratchFolder scratch;
  GuiFixture gui(hanging());
  EXPECT_EQ(gui.app().title(), "Hooke - Hanging");
  gui.unnail(0);
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
  gui.unnail(0);
  gui.key(letter('A'), control);
  gui.key(Key::Delete);
  gui.key(letter('S'), control);
  EXPECT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::None);
  EXPECT_EQ(load_scene(scratch.folder / "mine.json").scene.system.point_count(), 0);
}

// Reopened, the scene starts where it started, not where the run was when it was saved.
TEST(Documents, ContainTheStartAlsoWhenSavedDuringARun) {
  const ScratchFolder scratch;
  const Scene start = hanging();
  save_scene(start, scratch.folder / "net.json");
  GuiFixture gui(start, scratch.folder / "net.json");
  for (int frame = 0; frame < 8; ++frame) gui.key(Key::Period);
  const State run = gui.status().snapshot->state;
  gui.app().handle(Request(Edit{SetParameter{find_parameter("stiffness"), 200.0}}));
  gui.key(letter('S'), control);
  EXPECT_NE(gui.text().find("the start of the scene, not its state at t = 0.1333 s"), std::string::npos) << gui.text();
  const Scene saved = load_scene(scratch.folder / "net.json").scene;
  EXPECT_EQ(saved.state.time, 0.0);
  EXPECT_EQ(saved.state.position, start.state.position);
  EXPECT_EQ(saved.system.springs()[0].stiffness, 200.0);
  EXPECT_EQ(gui.app().title(), "Hooke - net");
  EXPECT_EQ(gui.status().snapshot->state.position, run.position);

  // the present state goes to another file, and the document stays what it is
  gui.app().handle(Request(Action::SavePresent));
  gui.frames(2);
  ASSERT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::Save);
  EXPECT_EQ(gui.app().panels().dialog.typed, (scratch.folder / "net-0.1333s.json").string());
  gui.key(Key::Enter);
  EXPECT_EQ(load_scene(scratch.folder / "net-0.1333s.json").scene.state.position, run.position);
  EXPECT_EQ(gui.app().document().file(), scratch.folder / "net.json");

  // or it becomes the start
  gui.app().handle(Request(Action::SetStart));
  gui.key(letter('S'), control);
  EXPECT_EQ(load_scene(scratch.folder / "net.json").scene.state.position, run.position);
}

TEST(Documents, ThePresentStateDoesNotReplaceTheFileOfTheScene) {
  const ScratchFolder scratch;
  save_scene(hanging(), scratch.folder / "net.json");
  GuiFixture gui(hanging(), scratch.folder / "net.json");
  for (int frame = 0; frame < 8; ++frame) gui.key(Key::Period);
  gui.app().handle(Request(Action::SavePresent));
  gui.frames(2);
  gui.app().panels().dialog = {};
  gui.app().handle(Request(SaveFile{scratch.folder / "net.json"}));
  gui.frames(2);
  EXPECT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::Message);
  EXPECT_EQ(load_scene(scratch.folder / "net.json").scene.state.time, 0.0);
}

TEST(Documents, AShippedSceneIsNeverOverwritten) {
  const ShippedScene& shipped = shipped_scenes().front();
  GuiFixture gui(load_scene(shipped.file).scene, shipped.file);
  gui.key(letter('S'), control);
  EXPECT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::Save);
  EXPECT_NE(gui.app().panels().dialog.typed, shipped.file.string());
}

TEST(Documents, ARefusedFileIsNamedAndTheOpenDocumentIsUnchanged) {
  const ScratchFolder scratch;
  std::ofstream(scratch.folder / "bad.json") << R"({"hooke": 1, "points": [{"position": [0, 0, 0], "mass": -1}]})";
  GuiFixture gui(hanging());
  gui.key(letter('O'), control);
  gui.type((scratch.folder / "bad.json").string());
  gui.key(Key::Enter);
  ASSERT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::Message);
  const std::string words = gui.text();
  for (const char* part : {"bad.json", "mass", "-1"}) EXPECT_NE(words.find(part), std::string::npos) << part;
  gui.key(Key::Enter);
  EXPECT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::None);
  EXPECT_EQ(gui.system().point_count(), 3);
  EXPECT_EQ(gui.status().document->name, "Hanging");
}

TEST(Documents, AFailedSaveIsReportedAndTheDocumentStaysModified) {
  GuiFixture gui(hanging());
  gui.unnail(0);
  gui.key(letter('S'), control_shift);
  gui.type("/nowhere/at/all.json");
  gui.key(Key::Enter);
  ASSERT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::Message);
  EXPECT_NE(gui.text().find("/nowhere/at/all.json"), std::string::npos);
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
  GuiFixture gui(load_scene(draped.file).scene, draped.file);
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
  GuiFixture gui(load_scene(draped.file).scene, draped.file);
  gui.app().handle(FileDrop{draped.scratch.folder.parent_path() / "other.png"});
  ASSERT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::Message);
  EXPECT_NE(gui.app().panels().dialog.text.find("\"../other.png\": must be in the folder of the scene, " + draped.scratch.folder.string()),
            std::string::npos);
  gui.key(Key::Enter);
  EXPECT_EQ(gui.status().document->view.texture, "");
}

TEST(Textures, OfAnUnsavedDocumentRequireSavingItFirst) {
  const Draped draped;
  GuiFixture gui(hanging());
  gui.app().handle(FileDrop{draped.scratch.folder / "mine.png"});
  EXPECT_NE(gui.app().panels().dialog.text.find("save the scene there first"), std::string::npos);
}

TEST(Documents, AskBeforeChangesAreLost) {
  const ScratchFolder scratch;
  GuiFixture gui(hanging());
  gui.unnail(0);
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
  GuiFixture gui(hanging());
  gui.key(letter('Q'), control);
  EXPECT_TRUE(gui.app().is_finished());
}

TEST(Dialogs, ReceiveAllKeysWhileOpen) {
  GuiFixture gui(hanging());
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
  GuiFixture gui(hanging());
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
