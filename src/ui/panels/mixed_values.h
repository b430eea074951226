// Values that a slider shows for many springs, points or colliders at once, and how it changes them: equal values are set, different ones
// scaled, so that their ratios stay.
#pragma once

#include <optional>
#include <vector>

#include "edit/command.h"
#include "scene/parameters.h"

namespace hooke {

// The springs that a slider acts on: the selected ones, else all.
struct AffectedSprings {
  bool all = true;
  std::vector<SpringId> selected;
};

// Whether the row sets a value of many springs, points or colliders, and not one of the scene.
bool has_many_values(const Parameter& row);
// The values that the row sets in these springs, in points or in colliders; empty for other rows.
CommonValue values_of(const Parameter& row, const System& system, const SheetWeights* sheet, const AffectedSprings& affected);

// The command that scales the values that `before` has so that their mean becomes `mean`; nothing if they cannot be scaled. Colliders
// stay where `now` has them.
std::optional<Command> scaled_values(const Parameter& row, const System& before, const System& now, const SheetWeights* sheet,
                                     const AffectedSprings& affected, double mean);

}  // namespace hooke
