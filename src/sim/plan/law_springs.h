// Packs the springs with a law.
#pragma once

#include "sim/plan/plan.h"

namespace hooke {

// Into a plan that has its runs.
void plan_laws(Plan& plan, const System& system);

}  // namespace hooke
