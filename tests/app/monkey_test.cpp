// Random keys and clicks never break anything. HOOKE_MONKEY sets the number of actions and HOOKE_SEED the sequence, for scripts/campaign.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "formats/scene_file.h"
#include "support/gui_fixture.h"
#include "support/scratch_folder.h"
#include "support/valid_scene.h"

namespace hooke {
namespace {

class Monkey {
 public:
  Monkey(GuiFixture& gui, unsigned seed) : gui_(gui), random_(seed) {}

  void act() {
    // must not overwrite files of the user
    const Dialog::Kind kind = gui_.app().panels().dialog.kind;
    if (kind == Dialog::Kind::Save || kind == Dialog::Kind::Unsaved) return gui_.key(Key::Escape);
    switch (below(12)) {
      case 0:
      case 1:
      case 2:
        return press_a_key();
      case 3:
        return gui_.click(somewhere(), Button::Left, some_modifiers());
      case 4:
        return gui_.click(in_scene(), Button::Left, some_modifiers());
      case 5:
        return gui_.drag(in_scene(), in_scene(), some_button(), some_modifiers());
      case 6:
        return gui_.drag(somewhere(), somewhere(), some_button(), some_modifiers());
      case 7:
        return click_twice(in_scene());
      case 8:
        return gui_.type(std::string(typed_[below(std::size(typed_))]));
      case 9:
        return gui_.app().handle(Scroll{static_cast<double>(below(7)) - 3.0, in_scene()});
      case 10:
        return gui_.key(below(2) == 0 ? Key::Escape : Key::Enter);
      default:
        return gui_.frames(3);
    }
  }

 private:
  static constexpr std::string_view typed_[] = {"1", "-3.5e2", "nan", "inf", "1e300", "x", "a/b", "never", "%s", "\xc3\xa9"};

  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  double between(double min, double max) { return std::uniform_real_distribution<double>(min, max)(random_); }
  glm::dvec2 somewhere() {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    return {between(-5.0, size.x + 5.0), between(-5.0, size.y + 5.0)};
  }
  glm::dvec2 in_scene() {
    const Rect& scene = gui_.app().layout().scene;
    return {scene.x + between(0.2, 0.8) * scene.width, scene.y + between(0.2, 0.8) * scene.height};
  }
  Button some_button() { return static_cast<Button>(below(3)); }
  Modifiers some_modifiers() { return {.control = below(6) == 0, .shift = below(4) == 0}; }
  void click_twice(const glm::dvec2& at) {
    gui_.click(at);
    gui_.app().handle(ButtonPress{Button::Left, at, {}, true});
    gui_.app().handle(ButtonRelease{Button::Left, at, {}});
  }
  // Any action of the table except quitting and saving, which would write to an arbitrary file.
  void press_a_key() {
    const Shortcut& row = shortcuts()[below(shortcuts().size())];
    if (row.action != Action::Quit && row.action != Action::Save && row.action != Action::SaveAs)
      gui_.key(row.key, row.modifiers, below(5) == 0);
  }

  GuiFixture& gui_;
  std::mt19937 random_;
};

TEST(Monkey, BreaksNothing) {
  const char* requested = std::getenv("HOOKE_MONKEY");
  const int actions = requested != nullptr ? std::atoi(requested) : 250;
  const ScratchFolder scratch;
  ::setenv("HOME", scratch.folder.c_str(), 1);
  const char* given_seed = std::getenv("HOOKE_SEED");
  unsigned seed = given_seed != nullptr ? 4 * static_cast<unsigned>(std::atoi(given_seed)) : 0;
  for (const char* scene : {"two_masses", "cloth_on_ball", "assignment", "grid_4x4"}) {
    GuiFixture gui(load_scene(find_scene(scene)).scene, {}, {scratch.folder / "config", scratch.folder / "state"});
    Monkey monkey(gui, ++seed);
    for (int i = 0; i < actions; ++i) {
      // repeated copying doubles the scene until it takes longer than a test should
      if (gui.status().snapshot->system->point_count() > 3000) {
        gui.key(letter('A'), {.control = true});
        gui.key(Key::Delete);
      }
      monkey.act();
      ASSERT_TRUE(is_valid(gui.status())) << scene << ", action " << i;
      ASSERT_FALSE(gui.app().is_finished());
    }
    // undone step by step to the opened scene, which must be valid
    while (gui.app().panels().dialog.kind != Dialog::Kind::None) gui.key(Key::Escape);
    for (int i = 0; i < 50; ++i) gui.key(letter('Z'), {.control = true});
    EXPECT_TRUE(is_valid(gui.status()));
  }
}

TEST(Keys, EveryKeyOfTheTableActsWithEveryTool) {
  for (const Shortcut& tool : shortcuts()) {
    if (tool.group != "Tools") continue;
    GuiFixture gui(load_scene(find_scene("three_masses")).scene);
    for (const Shortcut& row : shortcuts()) {
      if (row.action == Action::Quit) continue;
      gui.key(tool.key, tool.modifiers);
      gui.move({500.0, 400.0});
      gui.key(row.key, row.modifiers);
      ASSERT_TRUE(is_valid(gui.status())) << key_text(row);
      for (int i = 0; i < 3 && gui.app().panels().dialog.kind != Dialog::Kind::None; ++i) gui.key(Key::Escape);
      ASSERT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::None) << key_text(row);
      gui.app().panels().search.shown = gui.app().panels().shown.keys = gui.app().panels().export_state.is_shown = false;
      gui.frames(2);  // a menu opens
      if (gui.app().panels().menus.is_open) gui.key(Key::Escape);
    }
    gui.key(letter('Q'), {.control = true});
    gui.frames(2);
    EXPECT_TRUE(gui.app().is_finished() || gui.app().panels().dialog.kind == Dialog::Kind::Unsaved);
  }
}

}  // namespace
}  // namespace hooke
