// What a new user does in the first minutes: watch, play, build something, save it. In the real window, with few clicks and keys.
#include <gtest/gtest.h>

#include <cstdlib>
#include <glm/geometric.hpp>

#include "formats/scene_file.h"
#include "support/desktop.h"
#include "ui/layout.h"

namespace hooke {
namespace {

// Counts what the person does; a combination with Ctrl is one key.
class Person {
 public:
  explicit Person(Desktop& desktop) : desktop_(desktop) {}

  void key(const std::string& name) {
    desktop_.key(name);
    ++actions_;
  }
  void control(const std::string& name) {
    desktop_.control(name);
    ++actions_;
  }
  void type(const std::string& text) {
    desktop_.type(text);
    actions_ += static_cast<int>(text.size());
  }
  void click(const glm::dvec2& at) {
    desktop_.click(at);
    ++actions_;
  }
  void drag(const glm::dvec2& from, const glm::dvec2& to) {
    desktop_.drag(from, to);
    ++actions_;
  }
  int actions() const { return actions_; }

 private:
  Desktop& desktop_;
  int actions_ = 0;
};

TEST(FirstUse, RunsDragsReleasesBuildsATrussAndSavesItWithFortyClicksAndKeys) {
  Desktop desktop;
  ASSERT_TRUE(desktop.is_up());
  ::setenv("HOME", desktop.folder().c_str(), 1);
  Process program({HOOKE_PROGRAM}, desktop.folder() / "output");
  ASSERT_TRUE(desktop.wait_for_title("Hooke - Cloth"));
  rest(1.5);  // it has its title before it is on the screen, and takes keys only then
  const Rect view = lay_out(Desktop::width, Desktop::height, 1.0).scene;
  const glm::dvec2 middle(view.x + 0.5 * view.width, view.y + 0.5 * view.height);
  Person person(desktop);

  // play with the cloth
  person.key("space");
  rest(0.5);
  person.key("d");
  person.drag(middle, middle + glm::dvec2(120.0, -60.0));
  person.key("r");
  rest(1.0);
  desktop.save_screenshot("first_use_released.png");
  // no question: nothing of it has changed the scene
  person.control("n");
  ASSERT_TRUE(desktop.wait_for_title("Hooke - Untitled"));

  // a truss: the diagonals in a zigzag, then the upper and the lower chord
  const auto joint = [&](int i) { return middle + glm::dvec2(90.0 * (i - 3.5), i % 2 == 0 ? 0.0 : -150.0); };
  person.key("a");
  person.click(joint(0));
  person.key("t");
  for (int i = 0; i < 8; ++i) person.click(joint(i));
  for (const int i : {5, 3, 1}) person.click(joint(i));
  person.key("Escape");
  for (const int i : {0, 2, 4, 6}) person.click(joint(i));
  person.key("Escape");
  person.key("n");
  person.click(joint(0));
  person.click(joint(6));
  desktop.save_screenshot("first_use_built.png");
  person.key("space");
  rest(2.0);
  desktop.save_screenshot("first_use_running.png");

  // the dialog proposes a folder and selects the name alone
  person.control("s");
  rest(0.5);
  desktop.save_screenshot("first_use_saving.png");
  person.type("truss");
  person.key("Return");
  ASSERT_TRUE(desktop.wait_for_title("Hooke - truss"));
  EXPECT_LE(person.actions(), 40);

  const Scene saved = load_scene(desktop.folder() / "truss.json").scene;
  ASSERT_EQ(saved.system.point_count(), 8);
  EXPECT_EQ(saved.system.spring_count(), 13);
  EXPECT_EQ(std::ranges::count(saved.system.points(), true, &Point::nailed), 2);
  // the truss stands
  for (const Spring& spring : saved.system.springs()) {
    const double length = glm::distance(saved.state.position[saved.system.index_of(spring.first)],
                                        saved.state.position[saved.system.index_of(spring.second)]);
    EXPECT_NEAR(length, spring.rest_length, 0.05 * spring.rest_length);
  }
}

}  // namespace
}  // namespace hooke
