// The panels, run without a window: keys, lists, tools, menus, the legend.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "formats/scene_file.h"
#include "scene/shape.h"
#include "support/gui_sheets.h"
#include "support/two_springs.h"

namespace hooke {
namespace {

TEST(Shortcuts, NoTwoRowsShareAKey) {
  std::set<std::string> seen;
  for (const Shortcut& row : shortcuts()) EXPECT_TRUE(seen.insert(key_text(row)).second) << key_text(row);
}

TEST(Shortcuts, EachRowIsFoundByItsKeyAndDescribed) {
  for (const Shortcut& row : shortcuts()) {
    EXPECT_EQ(find_shortcut(row.key, row.modifiers), &row) << key_text(row);
    EXPECT_FALSE(row.text.empty());
    EXPECT_FALSE(row.group.empty());
    // with other modifiers the key has another meaning or none
    EXPECT_NE(find_shortcut(row.key, {.control = !row.modifiers.control, .shift = row.modifiers.shift}), &row);
  }
}

TEST(Shortcuts, TheOverlayShowsEveryRow) {
  GuiFixture gui;
  EXPECT_EQ(gui.text().find("Ctrl+Shift+Z"), std::string::npos);
  gui.key(Key::F1);
  const std::string words = gui.text();
  for (const Shortcut& row : shortcuts()) {
    EXPECT_NE(words.find(key_text(row)), std::string::npos) << key_text(row);
    EXPECT_NE(words.find(row.text), std::string::npos) << row.text;
  }
  for (const MouseHint& hint : mouse_hints()) EXPECT_NE(words.find(hint.gesture), std::string::npos);
  gui.key(Key::Escape);
  EXPECT_EQ(gui.text().find("Ctrl+Shift+Z"), std::string::npos);
}

TEST(Lists, AreClosedByEsc) {
  const auto is_open = [] { return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel); };
  GuiFixture gui(two_springs());
  for (const std::initializer_list<const char*> list : {std::initializer_list<const char*>{"##method"}, {"dimensions", "##choice"}}) {
    gui.click(gui.find("side", list));
    gui.frames(2);
    EXPECT_TRUE(is_open());
    gui.key(Key::Escape);
    EXPECT_FALSE(is_open());
  }
  gui.app().handle(Request(StartPlacement{find_shape_kind("hanging_rope")}));
  gui.frames(2);
  gui.click(gui.find("placing/rows", {"##held"}));
  gui.frames(2);
  EXPECT_TRUE(is_open());
  gui.key(Key::Escape);
  EXPECT_FALSE(is_open());
  EXPECT_TRUE(gui.app().panels().placement.is_on());
}

TEST(ToolBar, AClickSelectsTheToolAndItsNextStepIsShown) {
  GuiFixture gui(two_springs());
  for (const ToolRow& row : tools()) {
    const int action = static_cast<int>(row.action);
    // an item by number, found by its position in the bar
    const Rect& bar = gui.app().layout().tools;
    const double index = static_cast<double>(&row - tools().data());
    gui.click({bar.x + 0.5 * bar.width, bar.y + 30.0 + 58.0 * index});
    EXPECT_EQ(gui.app().tool(), row.action) << action;
    EXPECT_NE(gui.text().find(shortcut_of(row.action).text), std::string::npos);
  }
}

TEST(Menus, OpenUnderTheirNamesAndCloseOnEsc) {
  GuiFixture gui(two_springs());
  gui.click(gui.find("menu", {"Scenes"}));
  gui.frames(3);
  EXPECT_NE(gui.text().find("Cloth on a ball"), std::string::npos);
  gui.key(Key::Escape);
  EXPECT_EQ(gui.text().find("Cloth on a ball"), std::string::npos);
}

TEST(Menus, OfScenesFitsTheWindow) {
  GuiFixture gui(two_springs());
  gui.click(gui.find("menu", {"Scenes"}));
  gui.frames(3);
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  ASSERT_FALSE(context.OpenPopupStack.empty());
  EXPECT_EQ(context.OpenPopupStack.back().Window->ScrollMax.y, 0.0f);
}

TEST(Menus, ShowWhatUndoWillUndo) {
  GuiFixture gui(two_springs());
  gui.key(letter('R'));
  gui.click(gui.find("menu", {"Edit"}));
  gui.frames(3);
  EXPECT_NE(gui.text().find("Undo: release 1 point"), std::string::npos);
}

TEST(Legend, ShowsTheStrainsOfItsColors) {
  GuiFixture gui(two_springs());
  EXPECT_NE(gui.text().find("Strain"), std::string::npos);
  EXPECT_NE(gui.text().find("+0.01 %"), std::string::npos);
  gui.app().panels().view.strain_colors = false;
  EXPECT_EQ(gui.text().find("+0.01 %"), std::string::npos);
}

TEST(Legend, ShowsTheRangeOfSpringsThatAreAllCompressedOrAllStretched) {
  TestSim sim;
  const PointId a = sim.nail({-0.5, 0.0, 0.0}), b = sim.nail({0.0, 0.0, 0.0}), c = sim.nail({0.5, 0.0, 0.0});
  sim.join(a, b, 100.0, 1.0);
  sim.join(b, c, 100.0, 2.0);
  EXPECT_NE(GuiFixture(flat_scene("Compressed", sim)).text().find("-75 % to -50 %"), std::string::npos);
  sim.system.spring(0)->rest_length = 0.25;
  sim.system.spring(1)->rest_length = 0.4;
  EXPECT_NE(GuiFixture(flat_scene("Stretched", sim)).text().find("+25 % to +100 %"), std::string::npos);
}

TEST(Legend, ShowsNoRoundOff) {
  Scene scene = two_springs();
  scene.state.position[2].x = 0.5 + 1e-16;
  scene.system.spring(0)->rest_length = 0.1 + 0.2 + 0.2;
  scene.system.spring(1)->rest_length = std::nextafter(0.5, 1.0);
  GuiFixture gui(scene);
  EXPECT_NE(gui.text().find("0 % to 0 %"), std::string::npos) << gui.text();
}

// No point can be below it.
TEST(Legend, IsBelowTheSceneWhereTheSidePanelIsHidden) {
  GuiFixture gui(two_springs());
  gui.key(Key::Tab);
  for (const glm::dvec2& size : {glm::dvec2(1280.0, 800.0), {700.0, 450.0}, {300.0, 400.0}}) {
    gui.resize(size, 1.0);
    ASSERT_FALSE(gui.app().panels().shown.panels);
    EXPECT_NE(gui.text().find("Strain"), std::string::npos);
    const Layout& layout = gui.app().layout();
    EXPECT_EQ(layout.scene.y + layout.scene.height, layout.legend.y);
    EXPECT_EQ(layout.legend.y + layout.legend.height, layout.status.y);
    for (const Sheet& sheet : read_sheets(*ImGui::GetDrawData()))
      for (const Letter& letter : sheet.letters)
        if (sheet.window == "legend") {
          EXPECT_GE(letter.box.y, layout.legend.y);
        }
  }
  gui.app().panels().view.strain_colors = false;
  gui.resize({1280.0, 800.0}, 1.0);
  EXPECT_EQ(gui.app().layout().legend.height, 0.0);
}

TEST(Energies, HavePrefixes) {
  Scene scene = two_springs();
  for (Index s = 0; s < 2; ++s) scene.system.spring(s)->stiffness = 1e7;
  scene.state.position[2].x = 0.7;
  scene.settings.substeps = 400;
  GuiFixture gui(scene);
  gui.resize({1280.0, 2000.0}, 1.0);
  EXPECT_NE(gui.text().find("200 kJ"), std::string::npos) << gui.text();
  gui.key(letter('P'));
  gui.resize({1280.0, 2000.0}, 1.0);
  gui.app().handle(Request(Control(RunTo{0.02})));
  EXPECT_TRUE(gui.wait_for_end_of_run());
  EXPECT_NE(gui.text().find("[kJ]"), std::string::npos) << gui.text();
}

TEST(SidePanel, OfAnotherSceneIsScrolledToItsTop) {
  GuiFixture gui(two_springs());
  gui.resize({1280.0, 500.0}, 1.0);
  ImGuiWindow& side = *ImGui::FindWindowByName("side");
  side.ScrollTarget.y = 0.5f * side.ScrollMax.y;
  gui.frames(2);
  ASSERT_GT(side.Scroll.y, 0.0f);
  gui.app().handle(Request(OpenFile{find_scene("rope")}));
  gui.frames(3);
  EXPECT_EQ(gui.app().title(), "Hooke - Rope");
  EXPECT_EQ(side.Scroll.y, 0.0f);
}

TEST(EmptyScene, ShowsInstructions) {
  EXPECT_NE(GuiFixture(Scene{}).text().find("Press A and click to add points"), std::string::npos);
  EXPECT_EQ(GuiFixture(two_springs()).text().find("Press A and click to add points"), std::string::npos);
}

}  // namespace
}  // namespace hooke
