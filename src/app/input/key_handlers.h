// Which handler receives a key: an ordered list of handlers, from the topmost panel down to the shortcuts. The first one that handles the
// key ends the search.
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "app/tools/tune.h"
#include "app/window/event.h"
#include "ui/panels.h"

namespace hooke {

struct KeyHandler {
  std::string_view name;
  // Handles the key, or returns false to pass it on.
  std::function<bool(const KeyPress& press)> handle;
};
using KeyHandlers = std::vector<KeyHandler>;

struct Keyboard {
  KeyHandlers handlers;
  std::vector<PanelKey> for_panels{};  // passed to the panels in the next frame
  std::optional<LastTuning> tuned{};   // the last change of a value by a key
};

// The name of the handler that handled the key; empty if none did.
inline std::string_view dispatch(const KeyHandlers& handlers, const KeyPress& press) {
  for (const KeyHandler& handler : handlers)
    if (handler.handle(press)) return handler.name;
  return {};
}

}  // namespace hooke
