// The names of the history's steps, for the panel that shows them.
#pragma once

#include <string>
#include <vector>

namespace hooke {

struct HistoryList {
  std::vector<std::string> names;  // oldest first
  std::size_t done = 0;            // number of steps in effect; the others were undone
  long recorded = 0;               // number of edits ever recorded
  // The steps by which the document differs from what was saved, oldest first: "nail 3 points", "undo nail 3 points".
  std::vector<std::string> unsaved;
};

}  // namespace hooke
