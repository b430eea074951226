// Editing in the window: selection, copies, history and the command palette.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "formats/scene_file.h"
#include "scene/shape.h"
#include "sim/methods/integrator.h"
#include "support/gui_fixture.h"
#include "support/modifiers.h"
#include "support/test_sim.h"
#include "ui/search_results.h"

namespace hooke {
namespace {

// A pair of points connected by a spring, and a separate point.
Scene pair_and_one(int dimensions = 2) {
  TestSim sim;
  const PointId nail = sim.nail({-0.3, 0.4, 0.0}), bob = sim.add({0.1, 0.0, 0.0}, 2.0, {0.5, 0.0, 0.0});
  sim.add({0.5, 0.3, 0.0});
  sim.join(nail, bob, 70.0, 0.4);
  Scene scene;
  scene.name = "Pair";
  scene.system = sim.system;
  scene.system.dimensions = dimensions;
  scene.state = sim.state;
  return scene;
}

TEST(Selecting, ADoubleClickSelectsEverythingConnected) {
  GuiFixture gui(pair_and_one());
  const glm::dvec2 at = gui.seen({0.1, 0.0, 0.0});
  gui.click(at);
  EXPECT_EQ(gui.app().selection().points.size(), 1u);
  gui.app().handle(ButtonPress{Button::Left, at, {}, true});
  gui.app().handle(ButtonRelease{Button::Left, at, {}});
  EXPECT_EQ(gui.app().selection().points.size(), 2u);
  EXPECT_EQ(gui.app().selection().springs.size(), 1u);
}

TEST(Selecting, IsInvertedAndExtendedByKeys) {
  GuiFixture gui(pair_and_one());
  gui.click(gui.seen({-0.3, 0.4, 0.0}));
  gui.key(letter('L'), control);
  EXPECT_EQ(gui.app().selection().points.size(), 2u);
  gui.key(letter('I'), control);
  ASSERT_EQ(gui.app().selection().points.size(), 1u);
  EXPECT_TRUE(gui.app().selection().springs.empty());
  gui.key(letter('F'));
  const glm::dvec2 framed = gui.seen({0.5, 0.3, 0.0});
  const Rect& scene = gui.app().layout().scene;
  EXPECT_LT(glm::distance(framed, {scene.x + 0.5 * scene.width, scene.y + 0.5 * scene.height}), 1.0);
}

TEST(Selecting, ReachesEightPixelsAtEveryScale) {
  for (const double scale : {0.75, 1.0, 2.0, 3.0}) {
    GuiFixture gui(pair_and_one());
    gui.app().resize({1280.0, 800.0}, scale);
    gui.frames(2);
    gui.key(Key::Home);
    // a small point, missed by almost 8 pixels
    const glm::dvec2 at = gui.seen({0.5, 0.3, 0.0});
    gui.move(at + glm::dvec2(7.5, 0.0));
    EXPECT_TRUE(gui.app().marks().hovered_point) << scale;
    gui.click(at + glm::dvec2(0.0, 7.5));
    EXPECT_EQ(gui.app().selection().points.size(), 1u) << scale;
  }
}

TEST(Hovering, EndsWhereTheCursorLeavesTheWindow) {
  GuiFixture gui(pair_and_one());
  const glm::dvec2 at = gui.seen({0.5, 0.3, 0.0});
  gui.move(at);
  EXPECT_TRUE(gui.app().marks().hovered_point);
  gui.app().handle(Event(CursorLeave{}));
  gui.frames(1);
  EXPECT_FALSE(gui.app().marks().hovered_point);
  gui.move(at);
  EXPECT_TRUE(gui.app().marks().hovered_point);
}

TEST(Copies, DuplicatesAreDisplacedAndSelected) {
  for (const int dimensions : {2, 3}) {
    GuiFixture gui(pair_and_one(dimensions));
    gui.click(gui.seen({0.1, 0.0, 0.0}));
    gui.key(letter('L'), control);
    gui.key(letter('D'), control);
    const System& system = gui.system();
    ASSERT_EQ(system.point_count(), 5);
    ASSERT_EQ(system.spring_count(), 2);
    EXPECT_EQ(gui.app().selection().points.size(), 2u);
    EXPECT_EQ(gui.app().selection().points[0], system.points()[3].id);
    EXPECT_TRUE(system.points()[3].nailed);
    EXPECT_EQ(system.points()[4].mass, 2.0);
    EXPECT_EQ(system.springs()[1].stiffness, 70.0);
    const auto& position = gui.status().snapshot->state.position;
    const Vec3 displacement = position[3] - position[0];
    EXPECT_GT(glm::length(displacement), 0.01);
    EXPECT_LT(glm::length(position[4] - position[1] - displacement), 1e-12);
    gui.key(letter('Z'), control);
    EXPECT_EQ(gui.system().point_count(), 3);
    EXPECT_TRUE(gui.app().selection().empty());
  }
}

TEST(UndoAndRedo, SayWhatTheyChanged) {
  GuiFixture gui(pair_and_one());
  gui.key(letter('A'), control);
  gui.key(Key::Delete);
  EXPECT_EQ(gui.app().panels().messages.toast, "");
  gui.key(letter('Z'), control);
  EXPECT_EQ(gui.app().panels().messages.toast, "Undo: delete 3 points and 1 spring");
  gui.key(letter('Y'), control);
  EXPECT_EQ(gui.app().panels().messages.toast, "Redo: delete 3 points and 1 spring");
  gui.key(letter('Z'), control);
  gui.key(letter('A'), control);
  gui.key(letter('D'), control);
  ASSERT_EQ(gui.system().point_count(), 6);
  gui.key(letter('D'), control);
  gui.app().handle(Request(Control(GoToHistoryStep{0})));
  gui.frames(2);
  EXPECT_EQ(gui.system().point_count(), 3);
  EXPECT_EQ(gui.app().panels().messages.toast, "Undo: 2 steps");
}

TEST(UndoAndRedo, AnEditLikeTheOneThatWasUndoneIsNoRedo) {
  GuiFixture gui(pair_and_one());
  for (int times = 0; times < 2; ++times) {
    gui.key(letter('A'), control);
    gui.key(Key::Delete);
    EXPECT_FALSE(gui.app().panels().messages.toast.starts_with("Redo"));
    if (times == 0) gui.key(letter('Z'), control);
  }
}

TEST(Copies, PassBetweenTwoInstancesAsText) {
  std::string board;
  const Clipboard shared{.put = [&](const std::string& text) { board = text; }, .take = [&] { return board; }};
  {
    GuiFixture gui(pair_and_one());
    gui.app().use(shared);
    gui.key(letter('C'), control);
    EXPECT_EQ(gui.app().panels().messages.toast, "Nothing is selected");
    gui.key(letter('A'), control);
    gui.key(letter('X'), control);
    EXPECT_EQ(gui.system().point_count(), 0);
    EXPECT_EQ(gui.status().history.undo_name, "delete 3 points and 1 spring");
  }
  // the text on the clipboard is a regular scene
  EXPECT_EQ(parse_scene(board, "board").scene.system.point_count(), 3);
  GuiFixture gui(pair_and_one(3));
  gui.app().use(shared);
  const glm::dvec2 cursor(500.0, 300.0);
  gui.move(cursor);
  gui.key(letter('V'), control);
  ASSERT_EQ(gui.system().point_count(), 6);
  EXPECT_EQ(gui.system().spring_count(), 2);
  EXPECT_EQ(gui.app().selection().points.size(), 3u);
  // its center is under the cursor
  const auto& position = gui.status().snapshot->state.position;
  EXPECT_LT(glm::distance(gui.seen(0.5 * (position[3] + position[5]) + Vec3(0.0, -0.15, 0.0)), cursor), 25.0);
}

TEST(Copies, OfOtherClipboardContentAreRefusedWithAMessage) {
  GuiFixture gui(pair_and_one());
  std::string board;
  gui.app().use({.put = [&](const std::string& text) { board = text; }, .take = [&] { return board; }});
  for (const char* text : {"", "hello", "{}", "{\"hooke\": 1}", "{\"hooke\": 1, \"points\": [{\"position\": [0,0,1e999]}]}", "\xff"}) {
    board = text;
    gui.key(letter('V'), control);
    EXPECT_EQ(gui.system().point_count(), 3) << text;
    EXPECT_NE(gui.app().panels().messages.toast.find("The clipboard "), std::string::npos) << text;
  }
}

TEST(HistoryPanel, NamesEveryStepAndGoesToIt) {
  GuiFixture gui(pair_and_one());
  ImGui::GetIO().DisplaySize = {1280.0f, 2000.0f};
  gui.app().resize({1280.0, 2000.0}, 1.0);
  gui.key(letter('R'));
  gui.key(letter('A'), control);
  gui.key(letter('D'), control);
  gui.key(Key::Delete);
  gui.click(gui.find("side", {"History"}));
  gui.frames(3);
  const std::string words = gui.text();
  for (const char* step : {"As opened", "Release 1 point", "Add 3 points and 1 spring", "Delete 3 points and 1 spring", "3 of 3"})
    EXPECT_NE(words.find(step), std::string::npos) << step << " in\n" << words;

  // the second row: after the first step
  const ImGuiWindow* list = nullptr;
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
    if (std::string(window->Name).find("steps") != std::string::npos) list = window;
  ASSERT_NE(list, nullptr);
  const double line = ImGui::GetTextLineHeightWithSpacing();
  gui.click({list->Pos.x + 40.0, list->Pos.y + 1.5 * line});
  EXPECT_EQ(gui.system().point_count(), 3);
  EXPECT_FALSE(gui.system().points()[0].nailed);
  EXPECT_EQ(gui.status().history.list->done, 1u);
  gui.click({list->Pos.x + 40.0, list->Pos.y + 2.5 * line});
  EXPECT_EQ(gui.system().point_count(), 6);
}

std::vector<SearchResult> found_by(GuiFixture& gui, const std::string& typed) {
  gui.settled();
  return find_results(gui.app().panel_input({}), typed);
}

TEST(Search, FindsEveryActionByItsWords) {
  GuiFixture gui(pair_and_one());
  for (const ActionRow& row : actions()) {
    const auto found = found_by(gui, std::string(row.text));
    ASSERT_FALSE(found.empty()) << row.text;
    EXPECT_EQ(found.front().text, row.text);
  }
  EXPECT_TRUE(found_by(gui, "no such thing").empty());
  EXPECT_EQ(found_by(gui, "").size(), actions().size());
}

TEST(Search, NamesTheReasonWhyAParameterHasNoValue) {
  GuiFixture gui(pair_and_one());
  const auto found = found_by(gui, "friction 0");
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().text, "Friction: the scene has no collider");
  EXPECT_TRUE(found.front().requests.empty());
}

TEST(Search, FindsScenesPartsMethodsAndParametersWithValues) {
  Scene scene = pair_and_one();
  scene.system.colliders = {{.shape = Plane{{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}}}};
  GuiFixture gui(scene);
  const auto first = [&](const std::string& typed) {
    const auto found = found_by(gui, typed);
    return found.empty() ? std::string() : found.front().text;
  };
  const auto finds = [&](const std::string& typed, const std::string& text) {
    const auto found = found_by(gui, typed);
    return std::ranges::find(found, text, &SearchResult::text) != found.end();
  };
  EXPECT_EQ(first("friction 0"), "Set Friction to 0");
  EXPECT_EQ(first("substeps 60"), "Set Substeps to 60");
  EXPECT_EQ(first("substeps = 60"), "Set Substeps to 60");
  // beyond its range: what it would be, and the range
  EXPECT_EQ(found_by(gui, "restitution 7").front().text, "Set Restitution to 1");
  EXPECT_EQ(found_by(gui, "restitution 7").front().remark, "from 0 to 1");
  EXPECT_EQ(first("substeps 5000"), "Set Substeps to 5000");
  EXPECT_EQ(first("restitution"), "Restitution: 0");
  EXPECT_TRUE(finds("rope", "Open Rope"));
  EXPECT_TRUE(first("cloth").starts_with("Open Cloth")) << first("cloth");
  for (const ShapeKind& kind : placeable_shapes()) EXPECT_TRUE(finds(std::string(kind.label), "Add " + std::string(kind.label)));
  EXPECT_EQ(first("damped springs"), "Switch Damped springs off");
  EXPECT_TRUE(finds("xpbd", "Use method " + std::string(find_integrator("xpbd")->label)));
  for (const char* typed : {"2d", "2-d", "2D"}) EXPECT_TRUE(finds(typed, "New flat scene (2-D)")) << typed;
  for (const char* typed : {"3d", "3-d", "3D"}) {
    EXPECT_TRUE(finds(typed, "New 3-D scene")) << typed;
    EXPECT_TRUE(finds(typed, "Set Dimensions to 3-D")) << typed;
  }
}

TEST(Search, SetsAParameterThatIsChosenAndThenTyped) {
  GuiFixture gui(pair_and_one());
  gui.key(letter('P'), control_shift);
  gui.frames(2);
  gui.type("substeps");
  ASSERT_EQ(found_by(gui, "substeps").front().text, "Substeps: 20");
  gui.key(Key::Enter);
  gui.frames(2);
  EXPECT_EQ(gui.app().panels().search.typed, "Substeps ");
  gui.type("60");
  gui.key(Key::Enter);
  EXPECT_EQ(gui.status().snapshot->settings.substeps, 60);
}

TEST(Search, RunsTheChosenCommand) {
  GuiFixture gui(pair_and_one());
  gui.key(letter('P'), control_shift);
  gui.frames(2);
  EXPECT_NE(gui.text().find("Commands, scenes, parts"), std::string::npos);
  gui.type("release");
  EXPECT_NE(gui.text().find("Release all nails"), std::string::npos);
  EXPECT_TRUE(gui.system().points()[0].nailed);
  gui.key(Key::Enter);
  EXPECT_FALSE(gui.system().points()[0].nailed);
  EXPECT_FALSE(gui.app().panels().search.shown);

  // Esc closes it; the second result can be chosen
  gui.key(letter('P'), control_shift);
  gui.frames(2);
  gui.type("undo");
  gui.key(Key::Escape);
  EXPECT_FALSE(gui.app().panels().search.shown);
  EXPECT_FALSE(gui.system().points()[0].nailed);
  gui.key(letter('P'), control_shift);
  gui.frames(2);
  gui.type("select");
  gui.key(Key::Down);
  EXPECT_EQ(gui.app().panels().search.highlighted, 1);
}

}  // namespace
}  // namespace hooke
