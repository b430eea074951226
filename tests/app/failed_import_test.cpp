// A file that cannot be imported leaves the open document unchanged: scene, clock, history, name and modified mark.
#include <gtest/gtest.h>

#include <fstream>

#include "formats/scene_file.h"
#include "support/gui_fixture.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

struct BadFile {
  const char* name;
  std::string bytes;
};

std::vector<BadFile> bad_files() {
  return {
      {"empty.json", ""},
      {"truncated.json", R"({"hooke": 1, "points": [{"position": [0, 0)"},
      {"newer.json", R"({"hooke": 99})"},
      {"spring_to_nowhere.json", R"({"hooke": 1, "springs": [{"points": [0, 1], "stiffness": 1}]})"},
      {"too_many.json", R"({"hooke": 1, "generators": [{"type": "sheet", "columns": 90000, "rows": 90000}]})"},
      {"texture_outside.json", R"({"hooke": 1, "view": {"texture": "../secret.png"}})"},
      {"wrong_magic.xsp", "GIF89a"},
      {"truncated.xsp", "#1.0 *** XSpringies data file\nmass 1 2"},
      {"broken.obj", "v 0 0 zero\nf 1 2 3\n"},
      {"no_such_vertex.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"},
      {"nothing.obj", "# nothing\n"},
  };
}

// A document with history: a point was added, nothing was saved.
class OpenDocument {
 public:
  OpenDocument() : gui_(load_scene(find_scene("three_masses")).scene) {
    gui_.key(letter('A'));
    gui_.click({400.0, 300.0});
    before_ = gui_.status().snapshot;
    title_ = gui_.app().title();
  }
  GuiFixture& gui() { return gui_; }

  void expect_as_it_was(const std::string& what) {
    const Status& status = gui_.status();
    EXPECT_EQ(*status.snapshot->system, *before_->system) << what;
    EXPECT_EQ(status.snapshot->state, before_->state) << what;
    EXPECT_EQ(status.document->name, "Three masses") << what;
    EXPECT_TRUE(status.history.unsaved) << what;
    EXPECT_FALSE(status.history.undo_name.empty()) << what;
    EXPECT_EQ(gui_.app().title(), title_) << what;
  }
  // Declines to save, closes the message that appears, and returns whether there was one.
  bool is_error_shown() {
    for (int i = 0; i < 4 && gui_.app().panels().dialog.kind == Dialog::Kind::Unsaved; ++i) {
      gui_.click(gui_.find("Save changes?", {"Discard"}));
      gui_.frames(2);
    }
    const bool shown = gui_.app().panels().dialog.kind == Dialog::Kind::Message;
    gui_.key(Key::Enter);
    return shown;
  }

 private:
  GuiFixture gui_;
  std::shared_ptr<const Snapshot> before_;
  std::string title_;
};

TEST(FailedImport, LeavesTheOpenDocumentUnchanged) {
  const ScratchFolder scratch;
  OpenDocument document;
  for (const BadFile& bad : bad_files()) {
    const std::filesystem::path file = scratch.folder / bad.name;
    std::ofstream(file, std::ios::binary) << bad.bytes;
    document.gui().app().handle(FileDrop{file});
    document.gui().frames(2);
    EXPECT_TRUE(document.is_error_shown()) << bad.name;
    document.expect_as_it_was(bad.name);
  }
}

TEST(FailedImport, OfADirectoryOrMissingFileLeavesItUnchangedToo) {
  const ScratchFolder scratch;
  OpenDocument document;
  std::filesystem::create_directory(scratch.folder / "folder.json");
  for (const char* name : {"missing.json", "folder.json"}) {
    document.gui().app().handle(FileDrop{scratch.folder / name});
    document.gui().frames(2);
    EXPECT_TRUE(document.is_error_shown()) << name;
    document.expect_as_it_was(name);
  }
}

TEST(FailedImport, OfAPictureLeavesTheTextureUnchanged) {
  const ScratchFolder scratch;
  std::ofstream(scratch.folder / "scene.json") << format_scene(load_scene(find_scene("cloth")).scene);
  GuiFixture gui(load_scene(scratch.folder / "scene.json").scene, scratch.folder / "scene.json");
  std::ofstream(scratch.folder / "broken.png") << "\x89PNG\r\n\x1a\n and then nothing";
  gui.app().handle(FileDrop{scratch.folder / "broken.png"});
  gui.frames(2);
  EXPECT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::Message);
  EXPECT_EQ(gui.status().document->view.texture, "tartan");
  EXPECT_FALSE(gui.status().history.unsaved);
}

}  // namespace
}  // namespace hooke
