// Which handler receives a key: the topmost panel first, the shortcuts last.
#include "app/input/key_handlers.h"

#include "formats/open_file.h"
#include "support/gui_fixture.h"

namespace hooke {
namespace {

Scene two_masses() { return load_scene(find_scene("two_masses")).scene; }

std::string_view press(GuiFixture& gui, Key key, Modifiers modifiers = {}) {
  const std::string_view taken_by = dispatch(gui.app().key_handlers(), {key, modifiers});
  gui.frames(2);
  return taken_by;
}

TEST(KeyHandlers, AreCalledFromTheTopmostPanelDownToTheShortcuts) {
  GuiFixture gui;
  std::vector<std::string_view> names;
  for (const KeyHandler& handler : gui.app().key_handlers()) names.push_back(handler.name);
  EXPECT_EQ(names, (std::vector<std::string_view>{"dialog", "search", "menu", "export", "text field", "placement", "shortcut overlay",
                                                  "gallery", "shortcuts"}));
}

TEST(KeyHandlers, TheFirstToHandleAKeyKeepsItFromTheOthers) {
  int calls = 0;
  const KeyHandlers handlers = {{"pass", [&](const KeyPress&) { return ++calls, false; }},
                                {"first", [&](const KeyPress& press) { return ++calls, press.key == Key::Enter; }},
                                {"second", [&](const KeyPress&) { return ++calls, true; }}};
  EXPECT_EQ(dispatch(handlers, {Key::Enter, {}}), "first");
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(dispatch(handlers, {Key::Space, {}}), "second");
  EXPECT_EQ(dispatch({handlers[0]}, {Key::Space, {}}), "");
}

TEST(KeyHandlers, EscapeClosesOnePanelAfterAnother) {
  GuiFixture gui(two_masses());
  gui.app().handle(Request(Action::SelectAll));
  gui.app().handle(Request(StartPlacement{find_shape_kind("net")}));
  gui.app().handle(Request(Action::ShowKeys));
  gui.app().handle(Request(Action::Export));
  gui.app().panels().gallery.is_shown = true;
  gui.app().panels().search = {.shown = true, .is_new = true};
  gui.app().panels().show_message("Title", "Text");
  gui.frames(2);
  for (const char* name : {"dialog", "search", "export", "placement", "shortcut overlay", "gallery"}) {
    EXPECT_FALSE(gui.app().selection().empty()) << name;
    EXPECT_EQ(press(gui, Key::Escape), name);
  }
  EXPECT_EQ(press(gui, Key::Escape), "shortcuts");
  EXPECT_TRUE(gui.app().selection().empty());
}

TEST(KeyHandlers, ADialogAndTheCommandPaletteTakeEveryKey) {
  GuiFixture gui(two_masses());
  gui.app().panels().search = {.shown = true, .is_new = true};
  gui.frames(2);
  for (const Shortcut& row : shortcuts())
    if (row.action != Action::Cancel) {
      EXPECT_EQ(press(gui, row.key, row.modifiers), "search") << key_text(row);
    }
  gui.app().panels().show_message("Title", "Text");
  gui.frames(2);
  for (const Shortcut& row : shortcuts())
    if (row.action != Action::Cancel) {
      EXPECT_EQ(press(gui, row.key, row.modifiers), "dialog") << key_text(row);
    }
}

TEST(KeyHandlers, AMenuTakesEscapeBeforeTheSelection) {
  GuiFixture gui(two_masses());
  gui.key(letter('A'), {.control = true});
  gui.click(gui.find("menu", {"Edit"}));
  ASSERT_TRUE(gui.app().panels().menus.is_open);
  EXPECT_EQ(press(gui, Key::Escape), "menu");
  EXPECT_FALSE(gui.app().panels().menus.is_open);
  EXPECT_FALSE(gui.app().selection().empty());
}

TEST(KeyHandlers, ATextFieldPassesOnOnlyF1AndControlCombinations) {
  GuiFixture gui(two_masses());
  gui.app().handle(Request(StartPlacement{nullptr}));
  gui.app().panels().field.text_in_progress = true;
  const KeyHandlers& handlers = gui.app().key_handlers();
  for (const Key key : {Key::Escape, Key::Enter, Key::Space, letter('V'), Key::Up})
    EXPECT_EQ(dispatch(handlers, {key, {}}), "text field") << static_cast<int>(key);
  EXPECT_EQ(dispatch(handlers, {Key::F1, {}}), "shortcuts");
  EXPECT_EQ(dispatch(handlers, {letter('A'), {.control = true}}), "shortcuts");
}

TEST(KeyHandlers, TheGalleryKeepsKeysFromTheHiddenScene) {
  GuiFixture gui(two_masses());
  gui.app().panels().gallery.is_shown = true;
  for (const Key key : {Key::Right, Key::Down, Key::Left, Key::Up}) EXPECT_EQ(press(gui, key), "gallery");
  for (const Shortcut& row : shortcuts())
    if (row_of(row.action).needs != Needs::Nothing && row.group != "Tune") {
      EXPECT_EQ(press(gui, row.key, row.modifiers), "") << key_text(row);
    }
  EXPECT_FALSE(gui.status().history.unsaved);
}

TEST(KeyHandlers, AltAloneOpensAndClosesTheMenus) {
  GuiFixture gui(two_masses());
  EXPECT_EQ(press(gui, Key::Alt), "shortcuts");
  gui.frames(3);
  EXPECT_TRUE(gui.app().panels().menus.is_open);
  EXPECT_EQ(press(gui, Key::Alt), "menu");
  gui.frames(3);
  EXPECT_FALSE(gui.app().panels().menus.is_open);
}

TEST(KeyHandlers, F10OpensTheMenusWhichTheArrowsAndEnterOperate) {
  GuiFixture gui(two_masses());
  const auto imgui_key = [&](int key) {
    ImGui::GetIO().KeysDown[key] = true;
    gui.frame();
    ImGui::GetIO().KeysDown[key] = false;
    gui.frame();
  };
  press(gui, Key::F10);
  gui.frames(3);
  ASSERT_TRUE(gui.app().panels().menus.is_open);
  EXPECT_NE(gui.text().find("New flat scene"), std::string::npos);
  EXPECT_FALSE(ImGui::GetCurrentContext()->NavDisableHighlight) << "the focus is not visible";
  EXPECT_EQ(press(gui, Key::Right), "menu");
  gui.frames(2);
  EXPECT_EQ(press(gui, Key::Right), "menu");
  gui.frames(3);
  EXPECT_NE(gui.text().find("Select all"), std::string::npos);
  // keys of the scene do nothing while a menu is open
  EXPECT_EQ(press(gui, letter('A')), "menu");
  EXPECT_EQ(gui.app().tool(), Action::SelectTool);
  const ImGuiContext& imgui = *ImGui::GetCurrentContext();
  for (int i = 0; i < 8 && imgui.NavId != imgui.NavWindow->GetID("Select all"); ++i) imgui_key(ImGuiKey_DownArrow);
  press(gui, Key::Enter);
  gui.frames(2);
  EXPECT_FALSE(gui.app().panels().menus.is_open);
  EXPECT_FALSE(gui.app().selection().empty());
}

TEST(KeyHandlers, TabGoesToTheButtonsOfADialogAndEnterPressesTheFocusedOne) {
  GuiFixture gui(two_masses());
  bool later = false;
  gui.app().panels().show_message("Title", "Text", {{"First", CloseDialog{}}, {"Second", Action::SelectAll}});
  gui.frames(3);
  const auto tab = [&] {
    press(gui, Key::Tab);
    ImGui::GetIO().KeysDown[ImGuiKey_Tab] = true;
    gui.frame();
    ImGui::GetIO().KeysDown[ImGuiKey_Tab] = false;
    gui.frames(2);
  };
  for (int i = 0; i < 3 && !later; ++i) {
    tab();
    later = ImGui::GetCurrentContext()->NavId == GuiFixture::id_of("Message", {"Second"});
  }
  EXPECT_TRUE(later) << "Tab does not reach the second button";
  EXPECT_FALSE(ImGui::GetCurrentContext()->NavDisableHighlight) << "the focus is not visible";
  press(gui, Key::Enter);
  gui.frames(3);
  EXPECT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::None);
  EXPECT_EQ(gui.app().selection().points.size(), 2u);
}

}  // namespace
}  // namespace hooke
