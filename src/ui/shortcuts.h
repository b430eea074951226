// The keys of the table of commands, one by one: for bindings, the F1 overlay and the manual.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "ui/actions.h"

namespace hooke {

struct Shortcut {
  Key key;
  Modifiers modifiers;
  Action action;
  std::string_view group, text;
  bool repeats = false;
};

// Grouped, in the order of the table. An action with two keys has two consecutive rows.
std::span<const Shortcut> shortcuts();

// The row of this key, or null.
const Shortcut* find_shortcut(Key key, Modifiers modifiers);

// The first row of an action; every action has one.
const Shortcut& shortcut_of(Action action);

std::string key_text(const Shortcut& shortcut);

// Mouse actions besides the tools, for the overlay.
struct MouseHint {
  std::string_view gesture, text;
};
std::span<const MouseHint> mouse_hints();

}  // namespace hooke
