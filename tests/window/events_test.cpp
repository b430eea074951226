// The real window under all kinds of input: every key of the table, dropped files, the close button, and random keys and mouse events.
#include <gtest/gtest.h>

#include <cctype>
#include <map>
#include <random>

#include "formats/scene_file.h"
#include "support/desktop.h"
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
              {"points": [1, 2], "stiffness": 50}, {"points": [2, 3], "stiffness": 50}, {"points": [3, 1], "stiffness": 50}],
  "view": {"camera": {"eye": [0, 0.5, 4], "target": [0, 0.5, 0]}}})";

// "Ctrl+Shift+P" as xdotool names it.
std::string named_for_hands(const Shortcut& row) {
  static const std::map<std::string, std::string> names = {
      {"Space", "space"},         {"Esc", "Escape"}, {"Enter", "Return"}, {"Del", "Delete"},
      {"Backspace", "BackSpace"}, {".", "period"},   {",", "comma"},      {"[", "bracketleft"},
      {"]", "bracketright"},      {"=", "equal"},    {"-", "minus"}};
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

// The window with a scene in which every key has an effect: a point is selected and copied, there are steps to undo and redo, an earlier
// time to return to, and a changed view.
class Bench {
 public:
  Bench() : folder_(desktop.folder() / "work") {
    fs::create_directories(folder_);
    ::setenv("HOME", folder_.c_str(), 1);
    start();
  }

  void start() {
    program = Process();
    fs::remove_all(desktop.folder() / "state");
    fs::remove_all(desktop.folder() / "config");
    std::ofstream(file()) << four_points;
    program = Process({HOOKE_PROGRAM, file().string()}, output());
    ASSERT_TRUE(desktop.wait_for_title("Hooke - four"));
    ASSERT_TRUE(wait_for([&] { return is_steady(); }));
    select();
    press("ctrl+c ctrl+a Up Up ctrl+z period period");
    desktop.run_xdotool("click 4");
    ready_ = ready();
    ASSERT_FALSE(ready_.empty()) << contents(output());
  }

  // Restores the state before the key, by input or else by restarting.
  void make_ready(const std::string& key) {
    if (ready() == ready_) return;
    press(key);
    if (ready() != ready_) start();
  }
  bool changes_by(const std::string& keys) {
    const std::string before = shown();
    press(keys);
    return wait_for([&] { return shown() != before; }, 5.0);
  }

  void press(const std::string& keys) const {
    desktop.run_xdotool("key --clearmodifiers --delay 15 " + keys);
    rest(0.1);
  }
  fs::path file() const { return folder_ / "four.json"; }
  fs::path output() const { return desktop.folder() / "output"; }
  const fs::path& folder() const { return folder_; }

  Desktop desktop;
  Process program;

 private:
  // The bottom corner shows frame counts and milliseconds, which change.
  std::string shown() const { return desktop.digest(340, 28); }
  bool is_steady() const {
    const std::string once = shown();
    rest(0.1);
    return shown() == once;
  }
  void select() const {
    const Rect scene = lay_out(Desktop::width, Desktop::height, 1.0).scene;
    desktop.run_xdotool("mousemove " + std::to_string(static_cast<int>(scene.x + 0.5 * scene.width)) + " " +
                        std::to_string(static_cast<int>(scene.y + 0.5 * scene.height)) + " mousedown 1 sleep 0.06 mouseup 1");
  }
  // No key pressed, no dialog open, one point selected. Returns the picture, or nothing if it keeps changing.
  std::string ready() {
    press("Escape Escape Escape Escape");
    select();
    return wait_for([&] { return is_steady(); }, 5.0) ? shown() : std::string();
  }

  fs::path folder_;
  std::string ready_;
};

TEST(Window, RespondsToEveryKeyOfTheTable) {
  Bench context;
  ASSERT_FALSE(HasFatalFailure());
  for (const Shortcut& row : shortcuts()) {
    const std::string key = named_for_hands(row);
    // selecting the tool that is already active would not be visible
    if (row.action == Action::SelectTool) context.press("a");
    EXPECT_TRUE(context.changes_by(key)) << key_text(row) << ": " << row.text;
    EXPECT_TRUE(context.program.is_running() || row.action == Action::Quit) << key_text(row) << ": " << contents(context.output());
    context.make_ready(key);
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_EQ(contents(context.output()), "");
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
  const int events = requested != nullptr ? std::atoi(requested) : 1000;
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
