// What reaches the program from the window, in the order it happened. Places are in window coordinates.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <variant>

#include "ui/shortcuts.h"

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
  bool twice = false;  // soon after a press at the same place
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
struct Scroll {
  double steps;  // > 0: away from the person
  glm::dvec2 at;
};
struct FileDrop {
  std::filesystem::path file;
};
struct CloseRequest {};

using Event = std::variant<KeyPress, ButtonPress, ButtonRelease, CursorMove, Scroll, FileDrop, CloseRequest>;

}  // namespace hooke
