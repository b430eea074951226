// The springs of a scene in runs (SpringRun), as kernels use them.
#pragma once

#include <span>
#include <vector>

#include "sim/plan/plan.h"

namespace hooke {

// The points of each spring, in the order of the System.
std::vector<EdgeEnds> spring_ends(const System& system);

// Consecutive springs with consecutive ends form a run. `spring_index`: the spring of each packed one.
void find_runs(std::span<const EdgeEnds> springs, std::vector<SpringRun>& runs, std::vector<Index>& spring_index);

}  // namespace hooke
