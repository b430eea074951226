// Which handler receives a key: an ordered list of handlers, from the topmost panel down to the shortcuts. The first one that handles the
// key ends the search.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "app/window/event.h"

namespace hooke {

struct KeyHandler {
  std::string_view name;
  // Handles the key, or returns false to pass it on.
  std::function<bool(const KeyPress& press)> handle;
};
using KeyHandlers = std::vector<KeyHandler>;

// The name of the handler that handled the key; empty if none did.
inline std::string_view dispatch(const KeyHandlers& handlers, const KeyPress& press) {
  for (const KeyHandler& handler : handlers)
    if (handler.handle(press)) return handler.name;
  return {};
}

}  // namespace hooke
