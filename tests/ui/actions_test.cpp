// The table of actions: menus, buttons and keys follow from its rows.
#include "ui/actions.h"

#include "formats/open_file.h"
#include "support/gui_fixture.h"

namespace hooke {
namespace {

TEST(Actions, EachHasOneRowWithAKeyATextAndAGroup) {
  for (std::size_t i = 0; i < actions().size(); ++i) {
    const ActionRow& row = actions()[i];
    EXPECT_EQ(static_cast<std::size_t>(row.action), i);
    EXPECT_EQ(&row_of(row.action), &row);
    EXPECT_GT(row.keys.count, 0) << row.text;
    EXPECT_FALSE(row.text.empty());
    EXPECT_FALSE(row.group.empty()) << row.text;
  }
}

// Found by moving the mouse along the menu bar.
void open_menu(GuiFixture& gui, const char* name) {
  const Rect& bar = gui.app().layout().menu;
  const ImGuiID id = ImHashStr(name, 0, ImGui::FindWindowByName("menu")->ID);
  for (double x = 4.0; x < bar.width; x += 8.0) {
    gui.move({x, bar.y + 0.5 * bar.height});
    if (ImGui::GetCurrentContext()->HoveredId != id) continue;
    gui.click({x, bar.y + 0.5 * bar.height});
    return;
  }
  ADD_FAILURE() << "no menu " << name;
}

TEST(Actions, EachIsInItsMenuWithItsKey) {
  const std::pair<Menu, const char*> menus[] = {{Menu::File, "File"}, {Menu::Scenes, "Scenes"}, {Menu::Edit, "Edit"},
                                                {Menu::Add, "Add"},   {Menu::Run, "Run"},       {Menu::View, "View"}};
  GuiFixture gui(load_scene(find_scene("two_masses")).scene);
  for (const auto& [menu, name] : menus) {
    open_menu(gui, name);
    gui.frames(3);
    const std::string words = gui.text();
    for (const ActionRow& row : actions()) {
      if (row.position.menu != menu) continue;
      EXPECT_NE(words.find(row.text), std::string::npos) << name << ": " << row.text;
      EXPECT_NE(words.find(key_text(row.keys.chords[0])), std::string::npos) << name << ": " << row.text;
    }
    gui.key(Key::Escape);
  }
}

TEST(Actions, EachToolHasAButtonAndAClass) {
  ASSERT_EQ(tool_buttons().size(), tools().size());
  for (std::size_t i = 0; i < tools().size(); ++i) EXPECT_EQ(tool_buttons()[i].action, tools()[i].action);
}

}  // namespace
}  // namespace hooke
