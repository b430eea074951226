// Text that other programs see too.
#pragma once

#include <functional>
#include <string>

namespace hooke {

struct Clipboard {
  std::function<void(const std::string& text)> put;
  std::function<std::string()> take;
};

}  // namespace hooke
