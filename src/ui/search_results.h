// What the command palette finds: commands, shipped scenes, parts to add, methods, and parameters with their values.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ui/panels.h"

namespace hooke {

struct SearchResult {
  std::string text;    // "Set Friction to 0"
  std::string remark;  // on the right: the key, or what it is
  Requests requests;   // what choosing it asks for
  std::string typed;   // what it puts into the search field instead, so that a value can be added; empty: nothing
  int score = 0;       // of the match
};

// The quality of a match; 0 is none. Each typed word must occur in the text. Case and hyphens do not count: "2d" finds "2-D".
int match(std::string_view text, std::string_view typed);

// Best match first. "friction 0", "substeps 60" and "shear springs off" set parameters.
std::vector<SearchResult> find_results(const PanelInput& input, const std::string& typed);

}  // namespace hooke
