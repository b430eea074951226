// A spring that breaks.
#pragma once

#include "sim/forces/motion.h"

namespace hooke {

// Sets k and d of a packed spring of this length to zero, and adds its index in the System to `broken`. Adds the loss of its elastic energy
// to the energy ledger, and counts it. The grids are refreshed by the caller.
void break_spring(Plan& plan, Motion& motion, Index spring, double length, std::vector<Index>& broken);

}  // namespace hooke
