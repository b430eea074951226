// What the motion and the stability of the methods depend on, as one number, to notice edits.
#pragma once

#include "sim/plan/plan.h"

namespace hooke {

// 53 bits of a hash (FNV-1a, by words) of the values of the plan, without what moves by itself: the hand and colliders.
double rates_of(const Plan& plan);

}  // namespace hooke
