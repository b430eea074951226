// A home folder of its own, for tests of documents.
#pragma once

#include <filesystem>
#include <fstream>

#include "app/document/session.h"
#include "formats/scene_file.h"
#include "support/flat_scene.h"
#include "support/gui_fixture.h"
#include "support/modifiers.h"
#include "support/scratch_folder.h"

namespace hooke {

inline Scene two_points() {
  TestSim sim;
  const PointId nail = sim.nail({0.0, 0.5, 0.0}), bob = sim.add({0.2, 0.0, 0.0});
  sim.join(nail, bob, 100.0, 0.5);
  return flat_scene("Two points", sim);
}

// The folders of a user; unsaved work is autosaved after one second.
struct DocumentFixture {
  ScratchFolder scratch;
  std::filesystem::path folder = scratch.folder;
  Home home{folder / "config", folder / "state"};
  std::filesystem::path file = folder / "net.json";
  DocumentFixture() {
    std::filesystem::create_directories(home.config);
    write(home.config / "settings.json", R"({"autosave_seconds": 1})");
    save_scene(two_points(), file);
  }
  static void write(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }
  GuiFixture open() const { return GuiFixture(load_scene(file).scene, file, home); }
};

inline Dialog::Kind open_dialog(GuiFixture& gui) { return gui.app().panels().dialog.kind; }

// Presses a button of a dialog by its label.
inline void press_button(GuiFixture& gui, const char* box, const char* label) {
  gui.frames(2);
  const glm::dvec2 at = gui.find(box, {label});
  ASSERT_GT(at.x, 0.0) << label << " in\n" << gui.text();
  gui.click(at);
  gui.frames(2);
}

}  // namespace hooke
