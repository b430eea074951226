// The steps of undo by their names, for a panel that shows them.
#pragma once

#include <string>
#include <vector>

namespace hooke {

struct HistoryList {
  std::vector<std::string> names;  // oldest first
  std::size_t done = 0;            // so many of them are in effect, the others were taken back
};

}  // namespace hooke
