#include "ui/shortcuts.h"

#include <algorithm>
#include <array>
#include <vector>

namespace hooke {
namespace {

std::vector<Shortcut> all_shortcuts() {
  std::vector<Shortcut> all;
  for (const ActionRow& row : actions())
    for (const KeyChord& chord : row.keys) all.push_back({chord.key, chord.modifiers, row.action, row.group, row.text, row.keys.repeats});
  return all;
}

constexpr std::array hints{
    MouseHint{"Right or middle drag", "Orbit; pan in a flat scene"},
    MouseHint{"Shift + middle drag", "Pan"},
    MouseHint{"Wheel", "Zoom to the cursor"},
    MouseHint{"Double-click a point", "Select connected"},
    MouseHint{"Ctrl + click a slider", "Type a value"},
    MouseHint{"Right-click a slider", "Reset to default"},
};

constexpr std::array named_keys{
    std::pair{Key::Space, "Space"}, std::pair{Key::Escape, "Esc"}, std::pair{Key::Enter, "Enter"},
    std::pair{Key::Tab, "Tab"},     std::pair{Key::Delete, "Del"}, std::pair{Key::Backspace, "Backspace"},
    std::pair{Key::Right, "Right"}, std::pair{Key::Left, "Left"},  std::pair{Key::Down, "Down"},
    std::pair{Key::Up, "Up"},       std::pair{Key::Home, "Home"},  std::pair{Key::F1, "F1"},
    std::pair{Key::F10, "F10"},     std::pair{Key::F12, "F12"},    std::pair{Key::Alt, "Alt"},
};

}  // namespace

std::span<const Shortcut> shortcuts() {
  static const std::vector<Shortcut> all = all_shortcuts();
  return all;
}
std::span<const MouseHint> mouse_hints() { return hints; }

const Shortcut* find_shortcut(Key key, Modifiers modifiers) {
  for (const Shortcut& row : shortcuts())
    if (row.key == key && row.modifiers == modifiers) return &row;
  return nullptr;
}

const Shortcut& shortcut_of(Action action) {
  const auto all = shortcuts();
  return *std::ranges::find(all, action, &Shortcut::action);
}

std::string key_text(const KeyChord& chord) {
  std::string text;
  if (chord.modifiers.control) text += "Ctrl+";
  if (chord.modifiers.shift) text += "Shift+";
  for (const auto& [key, name] : named_keys)
    if (key == chord.key) return text + name;
  return text + static_cast<char>(chord.key);
}

std::string key_text(const Shortcut& shortcut) { return key_text(KeyChord{shortcut.key, shortcut.modifiers}); }

}  // namespace hooke
