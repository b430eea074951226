// A home folder of its own, for tests of documents.
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "app/document/session.h"
#include "formats/scene_file.h"
#include "support/flat_scene.h"
#include "support/gui_trial.h"
#include "support/modifiers.h"
#include "support/scratch_folder.h"

namespace hooke {

inline Scene two_points() {
  Trial trial;
  const PointId nail = trial.nail({0.0, 0.5, 0.0}), bob = trial.add({0.2, 0.0, 0.0});
  trial.join(nail, bob, 100.0, 0.5);
  return flat_scene("Two points", trial);
}

// The folders of a user; unsaved work is autosaved after one second.
struct OwnDesk {
  ScratchFolder scratch;
  std::filesystem::path folder = scratch.folder;
  Home home{folder / "config", folder / "state"};
  std::filesystem::path file = folder / "net.json";
  OwnDesk() {
    std::filesystem::create_directories(home.config);
    write(home.config / "settings.json", R"({"autosave_seconds": 1})");
    save_scene(two_points(), file);
  }
  static void write(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }
  GuiTrial open() const { return GuiTrial(load_scene(file).scene, file, home); }
};

// Builds frames until the condition holds, for at most some seconds.
template <class Condition>
bool wait_for(GuiTrial& gui, Condition condition) {
  for (int i = 0; i < 1000; ++i) {
    if (condition()) return true;
    gui.frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

inline Dialog::Kind open_dialog(GuiTrial& gui) { return gui.app().panels().dialog.kind; }

// Presses a button of a dialog by its label.
inline void press_button(GuiTrial& gui, const char* box, const char* label) {
  gui.frames(2);
  const glm::dvec2 at = gui.find(box, {label});
  ASSERT_GT(at.x, 0.0) << label << " in\n" << gui.words();
  gui.click(at);
  gui.frames(2);
}

}  // namespace hooke
