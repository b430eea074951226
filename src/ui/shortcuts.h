// The table of shortcuts: from a row follow the binding, the text of menus and tooltips, and a line of the F1 overlay.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace hooke {

// What a key, a button or a line of a menu does.
enum class Action {
  SelectTool,
  AddTool,
  AttachTool,
  NailTool,
  DragTool,
  CutTool,
  DeleteTool,
  RunOrPause,
  StepOnce,
  StepBack,
  Slower,
  Faster,
  GoToStart,
  ReleaseNails,
  StiffnessUp,
  StiffnessDown,
  SubstepsUp,
  SubstepsDown,
  Undo,
  Redo,
  SelectAll,
  SelectInverted,
  SelectConnected,
  Duplicate,
  Cut,
  Copy,
  Paste,
  DeleteSelection,
  Cancel,
  FrameAll,
  ShowPlots,
  HidePanels,
  LightOrDark,
  FrameSelection,
  ViewFront,
  ViewSide,
  ViewTop,
  Orthographic,
  FollowScene,
  CopyCamera,
  PasteCamera,
  LargerPanels,
  SmallerPanels,
  SearchCommands,
  ShowKeys,
  ShowGallery,
  NewScene,
  OpenScene,
  Save,
  SaveAs,
  Export,
  TakePicture,
  FilmOnOff,
  RecordOnOff,
  Quit,
};

// Keys by the letter or digit they print, capital; the others by GLFW's numbers (app checks that they are).
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
  F12 = 301,
};
constexpr Key letter(char capital) { return static_cast<Key>(capital); }

struct Modifiers {
  bool control = false, shift = false;
  bool operator==(const Modifiers&) const = default;
};

struct Shortcut {
  Key key;
  Modifiers modifiers;
  Action action;
  std::string_view group;  // heading in the overlay
  std::string_view text;   // in the overlay, in menus and in tooltips
  bool repeats = false;    // again and again while the key is held
};

// Grouped, in the order of the overlay. An action may have several keys; the first is the one shown in menus.
std::span<const Shortcut> shortcuts();

// The row of this key, or null.
const Shortcut* find_shortcut(Key key, Modifiers modifiers);

// The first row of an action; every action has one.
const Shortcut& shortcut_of(Action action);

// "Ctrl+Shift+Z"
std::string key_text(const Shortcut& shortcut);

// What the mouse does besides the tools, for the overlay.
struct MouseHint {
  std::string_view gesture, text;
};
std::span<const MouseHint> mouse_hints();

}  // namespace hooke
