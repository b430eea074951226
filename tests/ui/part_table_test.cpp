// The table of points and springs.
#include <gtest/gtest.h>

#include "support/gui_fixture.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

Scene flat_chain() {
  TestSim sim;
  const PointId a = sim.nail({-0.3, 0.4, 0.0}), b = sim.add({0.1, 0.0, 0.0}, 2.0, {0.5, 0.0, 0.0}), c = sim.add({0.5, 0.3, 0.0}, 4.0);
  sim.join(b, c, 90.0, 0.3);
  sim.join(a, b, 70.0, 0.4);
  Scene scene;
  scene.system = sim.system;
  scene.system.dimensions = 2;
  scene.state = sim.state;
  return scene;
}

void show_table(GuiFixture& gui) {
  gui.key(letter('T'), {.control = true});
  gui.resize({1280.0, 800.0}, 1.0);
  gui.frames(3);
}

// The innermost window of the table.
const ImGuiWindow* table_rows() {
  const ImGuiWindow* found = nullptr;
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
    if (window->Active && std::string_view(window->Name).starts_with("table/")) found = window;
  return found;
}

TEST(PartTable, ShowsPointsAndSelectsThem) {
  GuiFixture gui(flat_chain());
  show_table(gui);
  const std::string words = gui.text();
  for (const char* column : {"x [m]", "vx [m/s]", "mass [kg]"}) EXPECT_NE(words.find(column), std::string::npos) << column;
  EXPECT_EQ(words.find("vz [m/s]"), std::string::npos) << "the scene is flat";
  ASSERT_NE(table_rows(), nullptr);
  const ImGuiWindow& table = *table_rows();
  const double line = ImGui::GetTextLineHeight() + 4.0;
  gui.click({table.Pos.x + 12.0, table.Pos.y + 2.5 * line});
  EXPECT_EQ(gui.app().selection().points.size(), 1u);
  gui.key(letter('P'));
  EXPECT_TRUE(gui.app().panels().plots.is_shown);
  EXPECT_FALSE(gui.app().panels().plots.table.is_shown) << "plots have the same place";
}

TEST(PartTable, IsSortedByTheStiffnessOfSprings) {
  GuiFixture gui(flat_chain());
  show_table(gui);
  gui.click(gui.find("table", {"parts", "Springs"}));
  gui.frames(3);
  PartTable& table = gui.app().panels().plots.table;
  EXPECT_TRUE(table.of_springs);
  // sorted by the number at first
  EXPECT_EQ(table.order, (std::vector<Index>{0, 1}));
  ImGuiTable* shown = nullptr;
  for (int i = 0; i < ImGui::GetCurrentContext()->Tables.GetMapSize(); ++i)
    if (ImGuiTable* each = ImGui::GetCurrentContext()->Tables.TryGetMapData(i); each != nullptr && each->ColumnsCount == 9) shown = each;
  ASSERT_NE(shown, nullptr);
  ImGui::GetCurrentContext()->CurrentTable = shown;
  ImGui::TableSetColumnSortDirection(6, ImGuiSortDirection_Ascending, false);
  ImGui::GetCurrentContext()->CurrentTable = nullptr;
  gui.frames(3);
  EXPECT_EQ(table.order, (std::vector<Index>{1, 0}));
}

}  // namespace
}  // namespace hooke
