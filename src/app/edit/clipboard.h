// The text clipboard, shared with other programs once the window provides it.
#pragma once

#include <functional>
#include <string>

namespace hooke {

struct Clipboard {
  std::function<void(const std::string& text)> put;
  std::function<std::string()> take;
  std::string own{};  // text of the program, until the window provides the functions
};

}  // namespace hooke
