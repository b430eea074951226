// The real window under all kinds of input: every key of the table, dropped files, the close button, and random keys and mouse events.
#include <gtest/gtest.h>

#include <cctype>
#include <map>
#include <random>

#include "formats/scene_file.h"
#include "support/desktop.h"
#include "support/parts.h"
#include "ui/layout.h"
#include "ui/shortcuts.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

// A solid of four points above the ground, one of them at the center of the picture.
constexpr const char* four_points = R"({"hooke": 1, "name": "Four", "points": [
  {"position": [0, 0.5, 0], "radius": 0.08}, {"position": [0.6, 1.2, 0], "radius": 0.05, "nailed": true},
  {"position": [-0.6, 1.2, 0], "radius": 0.05}, {"position": [0, 1.2, 0.6], "radius": 0.05}],
  "springs": [{"points": [0, 1], "stiffness": 50}, {"points": [0, 2], "stiffness": 50}, {"points": [0, 3], "stiffness": 50},
              {"points": [1, 2], "stiffness": 50}, {"points": [2, 3], "stiffness": 50}, {"points": [3, 1], "stiffness": 50, "muscle": {"amplitude": 0.1}}],
  "view": {"camera": {"eye": [0, 0.5, 4], "target": [0, 0.5, 0]}}})";

// "Ctrl+Shift+P" as xdotool names it.
std::string named_for_hands(const Shortcut& row) {
  static const std::map<std::string, std::string> names = {
      {"Space", "space"},         {"Esc", "Escape"}, {"Enter", "Return"}, {"Del", "Delete"},
      {"Backspace", "BackSpace"}, {".", "period"},   {",", "comma"},      {"[", "bracketleft"},
      {"]", "bracketright"},      {"=", "equal"},    {"-", "minus"},      {"Alt", "alt"}};
  std::string text = key_text(row), before;
  for (const char* held : {"Ctrl+", "Shift+"}) {
    if (!text.starts_with(held)) continue;
    before += held;
    text = text.substr(std::string(held).size());
  }
  for (char& c : before) c = static_cast<char>(std::tolower(c));
  const auto name = names.find(text);
  if (name != names.end()) return before + name->second;
  return before + (text.size() == 1 ? std::string(1, static_cast<char>(std::tolower(text[0]))) : text);
}

// The keys pressed before an action so that it has an effect, and those that revert the effect.
struct KeysAround {
  Action action;
  const char *before, *after;
};
constexpr KeysAround all_keys_around[] = {
    {Action::SelectTool, "a", ""},
    {Action::RunOrPause, "", "space ctrl+r"},
    {Action::StepOnce, "", "ctrl+r"},
    {Action::StepBack, "period", "ctrl+r"},
    {Action::GoToStart, "period", ""},
    {Action::ResetParameters, "Up", "ctrl+z"},
    {Action::ReleaseNails, "", "ctrl+z"},
    {Action::Undo, "Up", ""},
    {Action::Redo, "Up ctrl+z", ""},
    {Action::Cut, "", "ctrl+z"},
    {Action::Paste, "ctrl+c", "ctrl+z"},
    {Action::Duplicate, "", "ctrl+z"},
    {Action::DeleteSelection, "", "ctrl+z"},
    {Action::LargerPanels, "", "ctrl+minus"},
    {Action::SmallerPanels, "", "ctrl+equal"},
    {Action::SwitchMuscles, "", "u"},
    {Action::SwitchDevice, "", "ctrl+shift+u"},
    {Action::ShowTimes, "", "ctrl+shift+h"},
    {Action::OpenMenus, "", "Escape"},
    {Action::ShowPlots, "", "p"},
    {Action::ShowAccuracy, "", "m"},
    {Action::HidePanels, "", "Tab"},
    {Action::FilmOnOff, "", "F12"},
    {Action::RecordOnOff, "", "ctrl+shift+r"},
};
KeysAround keys_around(Action action) {
  const auto found = std::ranges::find(all_keys_around, action, &KeysAround::action);
  return found == std::end(all_keys_around) ? KeysAround{action, "", ""} : *found;
}

// The window with a scene in which every key has an effect: a point is selected, and the picture does not change by itself.
class KeyFixture {
 public:
  KeyFixture() : folder_(desktop.folder() / "work") {
    fs::create_directories(folder_);
    ::setenv("HOME", folder_.c_str(), 1);
    start();
  }

  // Whether the picture changes. A used window is tried first, since a new one takes seconds; it may lack, say, something to undo.
  bool responds_to(const Shortcut& row) {
    for (const bool is_new : {false, true}) {
      if (HasFatalFailure() || !make_ready(keys_around(row.action).before)) continue;
      const std::string before = shown();
      press(named_for_hands(row));
      if (wait_for([&] { return shown() != before; }, is_new ? 5.0 : 1.0)) return true;
    }
    return false;
  }
  void restore(const Shortcut& row) {
    if (const std::string keys = keys_around(row.action).after; !keys.empty()) press(keys);
  }
  // Another document is open, the camera has moved away from the point, or methods are being compared.
  void restart_if_needed(const Shortcut& row) {
    const bool needed = row.action == Action::FrameAll || row.action == Action::NewFlatScene || row.action == Action::NewSpatialScene ||
                        row.action == Action::FastestStable;
    if (needed) start();
  }
  fs::path output() const { return desktop.folder() / "output"; }

  Desktop desktop;
  Process program;

 private:
  static bool HasFatalFailure() { return testing::Test::HasFatalFailure(); }
  void start() {
    program = Process();
    fs::remove_all(desktop.folder() / "state");
    fs::remove_all(desktop.folder() / "config");
    const fs::path file = folder_ / "four.json";
    std::ofstream(file) << four_points;
    program = Process({HOOKE_PROGRAM, file.string()}, output());
    ASSERT_TRUE(desktop.wait_for_title("Hooke - four"));
    ASSERT_TRUE(wait_for([&] { return is_steady(); })) << contents(output());
  }
  // Esc closes dialogs, hides messages and ends tools. The point at the center is selected.
  bool make_ready(const std::string& keys) {
    const Rect scene = lay_out(Desktop::width, Desktop::height, 1.0).scene;
    desktop.run_xdotool("key --clearmodifiers --delay 15 Escape Escape Escape Escape mousemove " +
                        std::to_string(static_cast<int>(scene.x + 0.5 * scene.width)) + " " +
                        std::to_string(static_cast<int>(scene.y + 0.5 * scene.height)) + " mousedown 1 sleep 0.06 mouseup 1");
    if (!keys.empty()) press(keys);
    return wait_for([&] { return is_steady(); }, 2.0);
  }
  void press(const std::string& keys) const { desktop.run_xdotool("key --clearmodifiers --delay 15 " + keys); }
  // Without the bottom corner, which shows frame counts and milliseconds.
  std::string shown() const { return desktop.digest(340, 28); }
  bool is_steady() const {
    const std::string once = shown();
    rest(0.1);
    return shown() == once;
  }

  fs::path folder_;
};

class KeysOfTheWindow : public InParts<3> {};
INSTANTIATE_TEST_SUITE_P(Daily, KeysOfTheWindow, testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Nightly, KeysOfTheWindow, testing::Range(1, KeysOfTheWindow::parts));

TEST_P(KeysOfTheWindow, ActAsTheTableSays) {
  KeyFixture window;
  ASSERT_FALSE(HasFatalFailure());
  int number = 0;
  for (const Shortcut& row : shortcuts()) {
    if (!has(number++)) continue;
    EXPECT_TRUE(window.responds_to(row)) << key_text(row) << ": " << row.text;
    EXPECT_TRUE(window.program.is_running() || row.action == Action::Quit) << key_text(row) << ": " << contents(window.output());
    window.restore(row);
    window.restart_if_needed(row);
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_EQ(contents(window.output()), "");
}

TEST(Window, OpensADroppedFile) {
  Desktop desktop;
  const fs::path file = desktop.folder() / "first.json", other = desktop.folder() / "other.json", broken = desktop.folder() / "broken.json";
  std::ofstream(file) << four_points;
  std::ofstream(other) << four_points;
  std::ofstream(broken) << "{\"hooke\": 1, \"points\": [";
  Process program({HOOKE_PROGRAM, file.string()}, desktop.folder() / "output");
  ASSERT_TRUE(desktop.wait_for_title("Hooke - first"));
  EXPECT_TRUE(desktop.send_to_window("drop", broken));
  rest(0.5);
  desktop.save_screenshot("window_dropped.png");
  EXPECT_EQ(desktop.window_title(), "Hooke - first\n");
  desktop.key("Escape");
  EXPECT_TRUE(desktop.send_to_window("drop", other));
  EXPECT_TRUE(desktop.wait_for_title("Hooke - other"));
}

// A desktop shows no stderr: a file that is double-clicked is opened with --from-desktop.
TEST(Window, SaysWhyAFileOfTheDesktopIsNotOpened) {
  Desktop desktop;
  const fs::path broken = desktop.folder() / "broken.json", other = desktop.folder() / "other.json";
  std::ofstream(broken) << "{\"hooke\": 1, \"points\": [";
  std::ofstream(other) << four_points;
  Process program({HOOKE_PROGRAM, "--from-desktop", broken.string()}, desktop.folder() / "output");
  ASSERT_TRUE(desktop.wait_for_title("Hooke - Cloth"));
  rest(1.5);
  desktop.save_screenshot("window_from_desktop.png");
  EXPECT_NE(contents(desktop.folder() / "output").find("broken.json"), std::string::npos);
  desktop.key("Escape");
  EXPECT_TRUE(desktop.send_to_window("drop", other));
  EXPECT_TRUE(desktop.wait_for_title("Hooke - other"));
}

TEST(Window, AsksBeforeClosingWithUnsavedChanges) {
  Desktop desktop;
  const fs::path file = desktop.folder() / "net.json";
  std::ofstream(file) << four_points;
  Process program({HOOKE_PROGRAM, file.string()}, desktop.folder() / "output");
  ASSERT_TRUE(desktop.wait_for_title("Hooke - net"));
  rest(1.5);
  const int substeps = load_scene(file).scene.settings.substeps;
  desktop.key("Right");
  ASSERT_TRUE(desktop.wait_for_title("Hooke - net*"));
  EXPECT_TRUE(desktop.send_to_window("close"));
  rest(0.5);
  ASSERT_TRUE(program.is_running());
  desktop.key("Return");  // saves and closes
  EXPECT_EQ(program.exit_code(), 0);
  EXPECT_GT(load_scene(file).scene.settings.substeps, substeps);
}

// HOOKE_EVENTS sets the number of events and HOOKE_SEED the sequence, for scripts/campaign.
TEST(Window, SurvivesRandomKeysAndMouseEvents) {
  const char* requested = std::getenv("HOOKE_EVENTS");
  const int events = requested != nullptr ? std::atoi(requested) : 200;
  Desktop desktop;
  const fs::path work = desktop.folder() / "work";
  fs::create_directories(work);
  fs::create_directories(desktop.folder() / "config" / "hooke");
  ::setenv("HOME", work.c_str(), 1);
  std::ofstream(desktop.folder() / "config" / "hooke" / "settings.json") << R"({"autosave_seconds": 1})";
  std::ofstream(work / "four.json") << four_points;
  const fs::path output = desktop.folder() / "output";
  Process program({HOOKE_PROGRAM, (work / "four.json").string()}, output);
  ASSERT_TRUE(desktop.wait_for_title("Hooke - four"));

  const char* seed = std::getenv("HOOKE_SEED");
  std::mt19937 random(seed != nullptr ? 11 + static_cast<unsigned>(std::atoi(seed)) : 11);
  const auto below = [&](int count) { return std::uniform_int_distribution<int>(0, count - 1)(random); };
  const auto event = [&]() -> std::string {
    const int kind = below(10);
    if (kind < 4) {
      const auto rows = shortcuts();
      const Shortcut& row = rows[static_cast<std::size_t>(below(static_cast<int>(rows.size())))];
      return row.action == Action::Quit ? "key Escape" : "key " + named_for_hands(row);
    }
    if (kind < 7) return "mousemove " + std::to_string(below(Desktop::width)) + " " + std::to_string(below(Desktop::height));
    if (kind == 7) return "click " + std::to_string(1 + below(5));
    if (kind == 8) return below(2) == 0 ? "mousedown 1" : "mouseup 1";
    static constexpr const char* typed[] = {"Return", "Escape", "1", "9", "minus", "e", "period", "Tab", "BackSpace"};
    return std::string("key ") + typed[below(static_cast<int>(std::size(typed)))];
  };
  constexpr int batch = 20;
  for (int i = 0; i < events; i += batch) {
    std::string events_of_batch;
    for (int k = 0; k < batch; ++k) events_of_batch += (k == 0 ? "" : " sleep 0.02 ") + event();
    desktop.run_xdotool(events_of_batch);
    ASSERT_TRUE(program.is_running()) << "after " << i + batch << " events: " << contents(output);
    // the saved scene is complete
    for (const fs::directory_entry& run : fs::directory_iterator(desktop.folder() / "state" / "hooke" / "runs"))
      if (const std::string kept = contents(run.path() / "scene.json"); !kept.empty()) {
        EXPECT_NO_THROW(parse_scene(kept, "kept"));
      }
  }
  desktop.run_xdotool("mouseup 1 key Escape");
  desktop.save_screenshot("window_after_events.png");
  EXPECT_EQ(contents(output), "");
}

}  // namespace
}  // namespace hooke
