// Messages stay until they are read, and are kept; a tool that does nothing says why.
#include <gtest/gtest.h>

#include <utility>

#include "support/gui_fixture.h"
#include "support/hanging_scene.h"

namespace hooke {
namespace {

// In long frames.
void wait(GuiFixture& gui, double seconds) {
  const float frame = std::exchange(ImGui::GetIO().DeltaTime, static_cast<float>(0.025 * seconds));
  gui.frames(40);
  ImGui::GetIO().DeltaTime = frame;
}

TEST(Messages, StayLongEnoughToBeReadAndLongerUnderTheMouse) {
  GuiFixture gui(hanging());
  const std::string line = "Saved the scene to a file whose path is so long that nobody reads it within two seconds";
  gui.app().panels().show_toast(line);
  wait(gui, 3.0);
  EXPECT_EQ(gui.app().panels().messages.toast, line);
  wait(gui, 10.0);
  EXPECT_EQ(gui.app().panels().messages.toast, "");

  gui.app().panels().show_toast(line);
  const Rect& scene = gui.app().layout().scene;
  gui.move({scene.x + 0.5 * scene.width, scene.y + scene.height - 78.0});
  wait(gui, 20.0);
  EXPECT_EQ(gui.app().panels().messages.toast, line);
  gui.move({scene.x + 5.0, scene.y + 5.0});
  wait(gui, 2.0);
  EXPECT_EQ(gui.app().panels().messages.toast, "");
}

TEST(Messages, AreKeptInALog) {
  GuiFixture gui(hanging());
  gui.app().panels().show_toast("The first message");
  gui.app().panels().show_toast("The second message");
  gui.app().panels().banners.file_warnings = "A warning in a banner";
  wait(gui, 8.0);
  gui.app().panels().banners.file_warnings.clear();
  gui.app().panels().show_value("k = 242 N/m");  // a value that is being tuned is no message
  wait(gui, 8.0);
  EXPECT_EQ(gui.text().find("The first message"), std::string::npos);
  gui.app().handle(Request(Action::ShowMessages));
  gui.frames(2);
  const std::string words = gui.text();
  for (const char* each : {"The first message", "The second message", "A warning in a banner"})
    EXPECT_NE(words.find(each), std::string::npos) << each << " in " << words;
  EXPECT_EQ(gui.app().panels().messages.entries.size(), 3u);
  gui.app().handle(Request(Action::ShowMessages));
  gui.frames(2);
  EXPECT_EQ(gui.text().find("The first message"), std::string::npos);
}

TEST(Tools, ThatDoNothingSayWhy) {
  GuiFixture gui(hanging());
  const glm::dvec2 empty = gui.seen({0.02, 0.15, 0.0});
  for (const auto& [key, words] :
       {std::pair{'N', "no point here"}, {'E', "nothing here to delete"}, {'D', "nothing here to drag"}, {'X', "No spring was crossed"}}) {
    gui.key(letter(key));
    gui.click(empty);
    EXPECT_NE(gui.app().panels().messages.toast.find(words), std::string::npos) << key << gui.app().panels().messages.toast;
  }
  const auto says = [&](const char* words) {
    gui.frames(1);
    EXPECT_NE(gui.app().panels().messages.toast.find(words), std::string::npos) << words << "; " << gui.app().panels().messages.toast;
    gui.app().panels().messages.toast.clear();
  };
  const glm::dvec2 point = gui.seen({0.2, 0.0, 0.0}), beside = point + glm::dvec2(6.0, 0.0);
  gui.key(letter('V'));
  gui.drag(empty, empty + glm::dvec2(20.0, -20.0));
  says("no point in this area");
  gui.key(letter('D'));
  gui.click(point);
  says("Hold the button");
  gui.key(letter('A'));
  gui.click(point);
  says("a point here already");
  for (const char tool : {'A', 'T'}) {
    gui.key(letter(tool));
    gui.drag(point, beside);
    says("needs two points");
  }
  EXPECT_EQ(gui.system().point_count(), 3);
  EXPECT_EQ(gui.status().history.undo_name, "");
}

TEST(Keys, ThatDoNothingSayWhy) {
  GuiFixture gui(hanging());
  const auto says = [&](Key key, Modifiers modifiers, const char* words) {
    gui.key(key, modifiers);
    EXPECT_NE(gui.app().panels().messages.toast.find(words), std::string::npos) << words << "; " << gui.app().panels().messages.toast;
  };
  says(letter('U'), {}, "no muscles");
  says(letter('Z'), {.control = true}, "nothing to undo");
  says(letter('Y'), {.control = true}, "nothing to redo");
  for (const Key key : {Key::Delete, letter('F')}) says(key, {}, "Nothing is selected");
  gui.key(letter('R'));
  says(letter('R'), {}, "No point is nailed");
}

TEST(AttachTool, AddsThePointsThatAreNotThere) {
  GuiFixture gui(hanging());
  gui.key(letter('T'));
  gui.click(gui.seen({0.05, 0.15, 0.0}));
  EXPECT_EQ(gui.system().point_count(), 4);
  EXPECT_EQ(gui.system().spring_count(), 2);
  gui.click(gui.seen({0.4, 0.1, 0.0}));
  EXPECT_EQ(gui.system().point_count(), 5);
  EXPECT_EQ(gui.system().spring_count(), 3);
  gui.key(Key::Escape);
  // a drag from empty space to a point
  gui.drag(gui.seen({0.25, 0.45, 0.0}), gui.seen({0.2, 0.0, 0.0}));
  EXPECT_EQ(gui.system().point_count(), 6);
  EXPECT_EQ(gui.system().spring_count(), 4);
}

}  // namespace
}  // namespace hooke
