// What the open and save dialogs show, the notice of an opened scene, and replays.
#include "app/app.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/document/files.h"
#include "formats/scene_file.h"
#include "lab/recording.h"
#include "scene/parameters.h"
#include "support/document_fixture.h"
#include "support/gui_fixture.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

TEST(OpenDialog, ListsRecordingsToo) {
  const DocumentFixture fixture;
  DocumentFixture::write(fixture.folder / "run.hookelog", "");
  GuiFixture gui = fixture.open();
  gui.key(letter('O'), control);
  gui.frames(3);
  EXPECT_NE(gui.text().find("run.hookelog"), std::string::npos) << gui.text();
}

TEST(SaveAsDialog, SelectsTheNameWithoutFolderAndExtension) {
  const DocumentFixture fixture;
  GuiFixture gui = fixture.open();
  gui.key(letter('S'), control_shift);
  gui.frames(3);
  gui.type("other");
  EXPECT_EQ(gui.app().panels().dialog.typed, (fixture.folder / "other.json").string());
}

TEST(SaveAsDialog, APathTypedInPlaceOfTheNameIsAPathOfItsOwn) {
  const DocumentFixture fixture;
  GuiFixture gui = fixture.open();
  gui.key(letter('S'), control_shift);
  gui.frames(3);
  gui.type((fixture.folder / "config" / "other.json").string());
  gui.key(Key::Enter);
  gui.frames(2);
  EXPECT_TRUE(fs::exists(fixture.folder / "config" / "other.json"));
  EXPECT_EQ(gui.app().document().file(), fixture.folder / "config" / "other.json");
}

TEST(Replay, ShowsTheTextureOfTheSceneAndChangesNoDocument) {
  const ScratchFolder scratch;
  Scene scene = load_scene(find_scene("cloth")).scene;
  ASSERT_EQ(scene.view.texture, "tartan");
  {
    GuiFixture gui(scene, scratch.folder / "cloth.json");
    gui.key(letter('R'), control_shift);
    gui.key(Key::Period);
    gui.key(Key::Up);
    gui.key(Key::Period);
    gui.key(letter('R'), control_shift);
  }
  const auto recording = std::make_shared<const Recording>(read_recording(scratch.folder / "cloth.hookelog"));
  GuiFixture replay;
  replay.app().document().play(recording);
  ASSERT_TRUE(replay.wait_until([&] { return !replay.status().run.running && replay.status().run.frames == 2; }));
  EXPECT_EQ(replay.status().recording.difference, "");
  ASSERT_TRUE(replay.status().document->cloth_texture.picture);
  EXPECT_EQ(replay.status().document->view.texture, "tartan");
  EXPECT_EQ(replay.app().title(), "Hooke - Cloth");
}

TEST(OpeningNotice, OfASceneAboutInstabilityIsItsLesson) {
  const fs::path file = find_scene("unstable");
  const LoadedScene loaded = load_scene(file);
  ASSERT_FALSE(loaded.warnings.empty());
  EXPECT_EQ(opening_notice(loaded.scene, loaded.warnings, file), loaded.scene.description);
  GuiFixture gui;
  gui.app().document().open(file);
  gui.frames(2);
  EXPECT_EQ(gui.app().panels().banners.file_warnings, loaded.scene.description);
  EXPECT_EQ(gui.text().find(".json"), std::string::npos);
}

TEST(OpeningNotice, OfAnotherSceneWarnsWithoutThePathOfItsFile) {
  const DocumentFixture fixture;
  DocumentFixture::write(fixture.folder / "odd.json", R"({"hooke": 1, "colour": 3, "points": [{"position": [0, 0, 0]}]})");
  GuiFixture gui = fixture.open();
  gui.app().document().open(fixture.folder / "odd.json");
  gui.frames(2);
  const std::string& notice = gui.app().panels().banners.file_warnings;
  EXPECT_NE(notice.find("colour"), std::string::npos);
  EXPECT_EQ(notice.find(fixture.folder.string()), std::string::npos) << notice;
}

TEST(OpeningNotice, OfTheSettingsStaysUntilTheyAreChangedAccordingly) {
  const DocumentFixture fixture;
  DocumentFixture::write(fixture.folder / "stiff.json", R"({"hooke": 1, "colour": 3, "points": [{"position": [0, 0, 0], "nailed": true},
    {"position": [1, 0, 0]}], "springs": [{"points": [0, 1], "stiffness": 1e6}],
    "simulation": {"integrator": "velocity_verlet", "frame_rate": 60, "substeps": 4}})");
  GuiFixture gui = fixture.open();
  gui.app().document().open(fixture.folder / "stiff.json");
  gui.frames(2);
  const std::string& notice = gui.app().panels().banners.file_warnings;
  const auto set_substeps = [&](double substeps) {
    gui.app().handle(Request(Edit{SetParameter{find_parameter("substeps"), substeps}}));
    gui.frames(2);
  };
  EXPECT_NE(notice.find("substeps: 4: may be too few"), std::string::npos) << notice;
  set_substeps(5);
  EXPECT_NE(notice.find("substeps: 5: may be too few"), std::string::npos) << notice;
  EXPECT_EQ(notice.find("substeps: 4"), std::string::npos) << notice;
  set_substeps(100);
  EXPECT_EQ(notice.find("substeps"), std::string::npos) << notice;
  EXPECT_NE(notice.find("colour"), std::string::npos) << notice;
}

}  // namespace
}  // namespace hooke
