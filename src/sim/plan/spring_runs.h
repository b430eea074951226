// The springs of a scene in runs (SpringRun), as kernels use them.
#pragma once

#include <vector>

#include "sim/plan/plan.h"

namespace hooke {

// Consecutive springs with consecutive ends form a run. `spring_index`: the spring of each packed one.
void find_runs(const System& system, std::vector<SpringRun>& runs, std::vector<Index>& spring_index);

}  // namespace hooke
