// The table of optional forces of a scene, besides gravity, springs, dashpots, drag and the hand. Adding one is a file in terms/
// and a line in terms/list.inc: its scene field, its panel and its manual follow from the row.
#pragma once

#include <string_view>

#include "base/table.h"
#include "sim/model/force_term.h"

namespace hooke {

Table<ForceTerm> force_terms();

// The row with this id, or null.
const ForceTerm* find_force_term(std::string_view id);

// The defaults of all parameters.
ForceValues default_values(const ForceTerm& term);

}  // namespace hooke
