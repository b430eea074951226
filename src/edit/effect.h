// What every command provides (command.h), and what applying one makes stale.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace hooke {

struct Command;

// The commands that undo exactly what one changed, to be applied in order.
using Inverse = std::vector<Command>;

struct Effect {
  bool structure = false;  // points or springs were added or removed: the Plan must be rebuilt
  bool values = false;     // the Plan's values must be refreshed
  bool motion = false;     // positions or velocities changed

  // Whether a frame that was begun before the edit must be computed again. An edit of a setting takes effect with the next frame.
  bool invalidates_frame() const { return structure || values || motion; }
};

// The names of the members of a command in its text form, in the order of declaration.
template <class... Text>
constexpr std::array<std::string_view, sizeof...(Text)> names(Text... text) {
  return {text...};
}

}  // namespace hooke
