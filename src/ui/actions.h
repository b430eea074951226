// The table of actions, made from actions.inc: the parts that the panels use.
#pragma once

#include <span>
#include <string_view>

#include "ui/icons.h"
#include "ui/keys.h"

namespace hooke {

enum class Action {
#define TOOL(id, ...) id,
#define ACTION(id, ...) id,
#include "ui/actions.inc"
};

enum class Menu { None, File, Scenes, Edit, Add, Run, View };

// A menu is divided into sections by lines; sections count from 1.
struct MenuPosition {
  Menu menu = Menu::None;
  int section = 0;
};
constexpr MenuPosition no_menu{};
constexpr MenuPosition in(Menu menu, int section) { return {menu, section}; }

// What an action requires. With Nothing it is also allowed while the gallery hides the scene.
enum class Needs { Nothing, Scene, Selection, Space /* a 3-D scene */, UndoStep, RedoStep };

struct ActionRow {
  Action action;
  KeyChords keys;  // the first is the one shown in menus
  MenuPosition position;
  Needs needs;
  std::string_view group;  // heading in the overlay
  std::string_view text;   // in the overlay, in menus and in tooltips
};

// In the order of actions.inc.
std::span<const ActionRow> actions();
const ActionRow& row_of(Action action);

struct ToolButton {
  Action action;
  Icon icon;
  std::string_view name;  // short, below the icon
};
// Of the toolbar, from the top.
std::span<const ToolButton> tool_buttons();

}  // namespace hooke
