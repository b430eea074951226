// The events of the window, in the order in which they happened. Positions are in window coordinates.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <variant>

#include "ui/keys.h"

namespace hooke {

struct KeyPress {
  Key key;
  Modifiers modifiers;
  bool repeated = false;  // held down
};
enum class Button { Left, Right, Middle };
struct ButtonPress {
  Button button;
  glm::dvec2 at;
  Modifiers modifiers;
  bool twice = false;  // the second press of a double click
};
struct ButtonRelease {
  Button button;
  glm::dvec2 at;
  Modifiers modifiers;
};
struct CursorMove {
  glm::dvec2 at;
  Modifiers modifiers;
};
struct CursorLeave {};  // the cursor is outside the window
struct Scroll {
  double steps;  // positive away from the user
  glm::dvec2 at;
};
struct FileDrop {
  std::filesystem::path file;
};
struct CloseRequest {};

using Event = std::variant<KeyPress, ButtonPress, ButtonRelease, CursorMove, CursorLeave, Scroll, FileDrop, CloseRequest>;

}  // namespace hooke
