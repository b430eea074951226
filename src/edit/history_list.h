// The names of the history's steps, for the panel that shows them.
#pragma once

#include <string>
#include <vector>

namespace hooke {

struct HistoryList {
  std::vector<std::string> names;  // oldest first
  std::size_t done = 0;            // number of steps in effect; the others were undone
};

}  // namespace hooke
