// Keys and key combinations, independent of the window system.
#pragma once

#include <array>
#include <string>

namespace hooke {

// A key is named by the capital letter or digit that it types; the others have the numbers of GLFW (app checks that they match).
enum class Key : int {
  Space = 32,
  Period = '.',
  Escape = 256,
  Enter = 257,
  Tab = 258,
  Backspace = 259,
  Delete = 261,
  Right = 262,
  Left = 263,
  Down = 264,
  Up = 265,
  Home = 268,
  F1 = 290,
  F10 = 299,
  F12 = 301,
  Alt = 342,  // pressed and released alone
};
constexpr Key letter(char capital) { return static_cast<Key>(capital); }

struct Modifiers {
  bool control = false, shift = false, alt = false;
  bool operator==(const Modifiers&) const = default;
};

struct KeyChord {
  Key key;
  Modifiers modifiers;
  bool operator==(const KeyChord&) const = default;
};

// "Ctrl+Shift+Z"
std::string key_text(const KeyChord& chord);

// The keys of an action: one, or two with the same effect.
struct KeyChords {
  std::array<KeyChord, 2> chords{};
  int count = 0;
  bool repeats = false;  // repeats while the key is held

  constexpr const KeyChord* begin() const { return chords.data(); }
  constexpr const KeyChord* end() const { return chords.data() + count; }
};

// How the rows of actions.inc name their keys: key('V'), ctrl('Z'), held(ctrl_shift('Z') | ctrl('Y')).
constexpr KeyChords key(Key plain) { return {{KeyChord{plain, {}}}, 1}; }
constexpr KeyChords key(char capital) { return key(letter(capital)); }
constexpr KeyChords ctrl(char capital) { return {{KeyChord{letter(capital), {.control = true}}}, 1}; }
constexpr KeyChords ctrl_shift(char capital) { return {{KeyChord{letter(capital), {.control = true, .shift = true}}}, 1}; }
constexpr KeyChords operator|(const KeyChords& first, const KeyChords& second) { return {{first.chords[0], second.chords[0]}, 2}; }
constexpr KeyChords held(KeyChords keys) {
  keys.repeats = true;
  return keys;
}

}  // namespace hooke
