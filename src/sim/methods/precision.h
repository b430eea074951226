// What can be computed in single precision (forces/single_precision.h).
#pragma once

#include <string>

#include "sim/model/settings.h"
#include "sim/plan/plan.h"

namespace hooke {

// What of the scene or of its method is not computed in single precision, such as "springs with dashpots"; empty: nothing.
std::string needs_double_precision(const Plan& plan, const Settings& settings);

}  // namespace hooke
