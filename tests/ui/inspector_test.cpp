// The inspector: typed properties of the selection; and invalid input typed into any field.
#include <gtest/gtest.h>

#include <cmath>

#include "formats/scene_file.h"
#include "scene/parameters.h"
#include "support/gui_fixture.h"
#include "support/parts.h"
#include "support/test_sim.h"
#include "support/valid_scene.h"
#include "ui/typed_field.h"

namespace hooke {
namespace {

constexpr Modifiers control{.control = true};

// Three points and two springs with different properties.
Scene chain(int dimensions = 3) {
  TestSim sim;
  const PointId a = sim.nail({-0.3, 0.4, 0.0}), b = sim.add({0.1, 0.0, 0.0}, 2.0, {0.5, 0.0, 0.0}), c = sim.add({0.5, 0.3, 0.0}, 4.0);
  sim.join(a, b, 70.0, 0.4);
  sim.join(b, c, 90.0, 0.3, 1.0);
  Scene scene;
  scene.name = "Chain";
  scene.system = sim.system;
  scene.system.dimensions = dimensions;
  scene.system.point(2).color = Color{1, 2, 3};
  scene.state = sim.state;
  return scene;
}

struct Field {
  const char* group;
  const char* id;
};
constexpr Field fields[] = {{"points", "Position x"}, {"points", "Position y"},   {"points", "Position z"},
                            {"points", "mass"},       {"points", "radius"},       {"springs", "Stiffness k"},
                            {"springs", "Damping d"}, {"springs", "Rest length"}, {"springs", "Breaks at"}};

// With a window so tall that nothing scrolls, and everything selected.
class Inspector : public GuiFixture {
 public:
  explicit Inspector(const Scene& scene) : GuiFixture(scene) {
    ImGui::GetIO().DisplaySize = {1280.0f, 2400.0f};
    app().resize({1280.0, 2400.0}, 1.0);
    key(letter('A'), control);
    frames(3);
  }

  // The position of the field.
  glm::dvec2 place_of(const Field& field) {
    const ImGuiWindow* side = ImGui::FindWindowByName("side");
    ImGuiID id = ImHashStr(field.group, 0, side->ID);
    id = ImHashStr(field.id, 0, id);
    id = ImHashStr("##typed", 0, id);
    for (double y = 4.0; y < 1200.0; y += 6.0) {
      move({side->Pos.x + 0.5 * side->Size.x, side->Pos.y + y});
      if (ImGui::GetCurrentContext()->HoveredId == id) return {side->Pos.x + 0.5 * side->Size.x, side->Pos.y + y};
    }
    return {-1.0, -1.0};
  }
  void type_at(const glm::dvec2& place, const std::string& text) {
    click(place);
    type(text);
    click({1270.0, 2300.0});  // elsewhere in the panel
    frames(2);
  }
  void type_into(const Field& field, const std::string& text) {
    const glm::dvec2 place = place_of(field);
    ASSERT_GT(place.x, 0.0) << field.group << " " << field.id;
    type_at(place, text);
  }
};

TEST(Inspector, SetsAPropertyOfAllAndUndoRestoresEachValue) {
  const Scene scene = chain();
  Inspector gui(scene);
  EXPECT_NE(gui.text().find("3 points, 2 springs"), std::string::npos);
  EXPECT_NE(gui.text().find("varies, ~"), std::string::npos);
  gui.type_into({"points", "mass"}, "3.5");
  for (const Point& point : gui.system().points()) EXPECT_EQ(point.mass, 3.5);
  EXPECT_EQ(gui.status().history.undo_name, "mass of 3 points to 3.5 kg");
  gui.type_into({"points", "radius"}, "0.1");
  for (const Point& point : gui.system().points()) EXPECT_EQ(point.radius, 0.1);
  gui.type_into({"springs", "Stiffness k"}, "250");
  gui.type_into({"springs", "Damping d"}, "0.5");
  gui.type_into({"springs", "Rest length"}, "0.25");
  gui.type_into({"springs", "Breaks at"}, "0.75");
  for (const Spring& spring : gui.system().springs()) {
    EXPECT_EQ(spring.stiffness, 250.0);
    EXPECT_EQ(spring.damping, 0.5);
    EXPECT_EQ(spring.rest_length, 0.25);
    EXPECT_EQ(spring.break_strain, 0.75);
  }
  gui.type_into({"springs", "Breaks at"}, "never");
  EXPECT_EQ(gui.system().springs()[0].break_strain, never_breaks);
  gui.type_into({"points", "Position y"}, "-0.2");
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(gui.status().snapshot->state.position[i], Vec3(scene.state.position[i].x, -0.2, 0.0));
    EXPECT_EQ(gui.status().snapshot->state.velocity[i], scene.state.velocity[i]);
  }
  for (int step = 0; step < 8; ++step) gui.key(letter('Z'), control);
  EXPECT_EQ(gui.system(), scene.system);
  EXPECT_EQ(gui.status().snapshot->state.position, scene.state.position);
  EXPECT_TRUE(gui.status().history.undo_name.empty());
}

TEST(Inspector, NailsAndColorsAll) {
  Inspector gui(chain());
  const glm::dvec2 box = gui.find("side", {"points", "##nailed"});
  ASSERT_GT(box.x, 0.0);
  gui.click(box);
  for (const Point& point : gui.system().points()) EXPECT_TRUE(point.nailed);
  gui.click(box);
  for (const Point& point : gui.system().points()) EXPECT_FALSE(point.nailed);
  gui.click(gui.find("side", {"points", "By state"}));
  for (const Point& point : gui.system().points()) EXPECT_FALSE(point.color);
  gui.key(letter('Z'), control);
  EXPECT_EQ(gui.system().points()[2].color, (Color{1, 2, 3}));
}

TEST(Inspector, SetsTheVelocityOfFreePointsAsOneStep) {
  Inspector gui(chain());
  gui.app().handle(Request(Edit{SetNailed{{{gui.system().points()[0].id, true}}}}));
  gui.frames(2);
  const glm::dvec2 place = gui.find("side", {"points", "Velocity y", "##typed"});
  ASSERT_GT(place.x, 0.0);
  gui.type_at(place, "-2.5");
  const State& state = gui.status().snapshot->state;
  EXPECT_EQ(state.velocity[0], Vec3(0.0));
  EXPECT_EQ(state.velocity[1], Vec3(0.5, -2.5, 0.0));
  EXPECT_EQ(state.velocity[2], Vec3(0.0, -2.5, 0.0));
  gui.key(letter('Z'), control);
  EXPECT_EQ(gui.status().snapshot->state.velocity[1], Vec3(0.5, 0.0, 0.0));
}

TEST(Inspector, SetsLoadsAndFixedAxesOfAllAndUndoRestoresThem) {
  const Scene scene = chain();
  Inspector gui(scene);
  gui.type_at(gui.find("side", {"points", "Load y", "##typed"}), "-2.5");
  for (const Point& point : gui.system().points()) EXPECT_EQ(point.load, Vec3(0.0, -2.5, 0.0));
  EXPECT_EQ(gui.status().history.undo_name, "load of 3 points");
  const glm::dvec2 x = gui.find("side", {"points", "x"}), z = gui.find("side", {"points", "z"});
  gui.click(0.5 * (x + z));
  gui.click(z);
  for (const Point& point : gui.system().points()) EXPECT_EQ(point.fixed_axes, 6);
  EXPECT_EQ(gui.status().history.undo_name, "fix yz of 3 points");
  for (int step = 0; step < 3; ++step) gui.key(letter('Z'), control);
  EXPECT_EQ(gui.system(), scene.system);
}

TEST(Inspector, IsShownOnlyForASelectionAndFollowsIt) {
  Inspector gui(chain(2));
  EXPECT_EQ(gui.text().find("Position z"), std::string::npos);
  gui.key(Key::Escape);
  EXPECT_EQ(gui.text().find("Position x"), std::string::npos);
}

TEST(Inspector, EscWhileTypingKeepsTheSelection) {
  Inspector gui(chain());
  gui.click(gui.place_of({"points", "mass"}));
  gui.type("9");
  gui.key(Key::Escape);
  EXPECT_EQ(gui.app().selection().points.size(), 3u);
}

TEST(TypedNumbers, AreParsedAsDocumented) {
  EXPECT_EQ(number_typed(" 1.5 "), 1.5);
  EXPECT_EQ(number_typed("+2e3"), 2000.0);
  EXPECT_EQ(number_typed("1e999"), INFINITY);
  EXPECT_EQ(number_typed("-1e999"), -INFINITY);
  EXPECT_EQ(number_typed("1e-999"), 0.0);
  EXPECT_EQ(number_typed("never", "never"), INFINITY);
  for (const char* text : {"", "abc", "1,5", "nan", "NAN", "-nan", "1 2", "0x", "--1", "never", "1m", "e5"})
    EXPECT_FALSE(number_typed(text)) << text;
}

// The scene as published.
Scene scene_of(GuiFixture& gui) {
  Scene scene;
  scene.system = gui.system();
  scene.state = gui.status().snapshot->state;
  scene.settings = gui.status().snapshot->settings;
  return scene;
}

const std::string absurd[] = {"",      "abc",    "nan", "-nan(7)", "inf", "-inf", "1e300", "-1e300",
                              "1e999", "1e-300", "-1",  "0x1p9",   "1,5", "%n%s", "\\",    std::string(3000, '9'),
                              "0"};

TEST(BadInput, TypedIntoAnyFieldOfTheInspectorDoesNoHarm) {
  Inspector gui(chain());
  for (const Field& field : fields) {
    const glm::dvec2 place = gui.place_of(field);
    ASSERT_GT(place.x, 0.0);
    for (const std::string& text : absurd) {
      gui.type_at(place, text);
      ASSERT_TRUE(is_valid(gui.status())) << field.id << " " << text;
    }
  }
  EXPECT_FALSE(gui.app().is_finished());
  // the saved scene can be read again
  EXPECT_EQ(parse_scene(format_scene(scene_of(gui)), "typed").scene.system.point_count(), 3);
}

TEST(BadInput, ANonNumberKeepsTheValueWithAMessage) {
  Inspector gui(chain());
  const std::vector<Point> before(gui.system().points().begin(), gui.system().points().end());
  gui.type_into({"points", "mass"}, "heavy");
  EXPECT_EQ(gui.app().panels().messages.toast, "\"heavy\" is not a number; Mass is unchanged");
  gui.type_into({"points", "mass"}, "1e300");
  EXPECT_EQ(gui.app().panels().messages.toast, "Mass must be from 1\u00d710\u207b\u2079 to 1\u00d710\u2079 kg; it is unchanged");
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(gui.system().points()[i].mass, before[i].mass);
}

class BadInputOfSliders : public InParts<3> {};
INSTANTIATE_TEST_SUITE_P(Daily, BadInputOfSliders, testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Nightly, BadInputOfSliders, testing::Range(1, BadInputOfSliders::parts));

TEST_P(BadInputOfSliders, DoesNoHarm) {
  Inspector gui(chain());
  gui.key(Key::Escape);
  gui.frames(2);
  gui.click(gui.find("side", {"Hand"}));  // expands the group
  int number = 0, tried = 0;
  for (const Parameter& row : parameters()) {
    if (row.kind == Parameter::Kind::Switch || !has(number++)) continue;
    const glm::dvec2 place = gui.find("side", {row.name.data(), "##value"});
    if (place.x < 0.0) continue;  // the scene has no such item
    ++tried;
    for (const std::string& text : absurd) {
      gui.click(place, Button::Left, control);
      gui.type(text);
      gui.click({1270.0, 2300.0});
      gui.frames(2);
      ASSERT_TRUE(is_valid(gui.status())) << row.name << " " << text;
    }
  }
  EXPECT_GT(tried, 2);
}

TEST(BadInput, WindowsOfOnePixelAndOfEightThousandHaveTheirPanels) {
  for (const glm::dvec2 size :
       {glm::dvec2(1.0), glm::dvec2(8000.0), glm::dvec2(8000.0, 1.0), glm::dvec2(1.0, 8000.0), glm::dvec2(640.0, 420.0)}) {
    for (const double scale : {0.75, 1.0, 3.0}) {
      GuiFixture gui(chain());
      ImGui::GetIO().DisplaySize = {static_cast<float>(size.x), static_cast<float>(size.y)};
      gui.app().resize(size, scale);
      gui.frames(2);
      const Rect& scene = gui.app().layout().scene;
      EXPECT_GE(scene.width, 1.0);
      EXPECT_GE(scene.height, 1.0);
      for (const char key : {'O', 'S', 'A'}) {
        gui.key(letter(key), control);
        gui.frames(2);
        gui.key(Key::Escape);
      }
      gui.key(Key::F1);
      gui.key(Key::F1);
      gui.key(letter('P'), {.control = true, .shift = true});
      gui.key(Key::Escape);
      gui.key(Key::Home);
      gui.click(0.5 * size);
      gui.drag(0.4 * size, 0.6 * size);
      gui.drag(0.4 * size, 0.6 * size, Button::Right);
      gui.app().handle(Scroll{3.0, 0.5 * size});
      gui.frames(2);
      const Camera& camera = gui.app().camera();
      EXPECT_TRUE(std::isfinite(camera.distance + camera.target.x + camera.target.y + camera.back.x))
          << size.x << " x " << size.y << " at " << scale;
      EXPECT_TRUE(is_valid(gui.status()));
      EXPECT_EQ(gui.system().point_count(), 3);
    }
  }
}

}  // namespace
}  // namespace hooke
