// Spring forces, for the widest vector unit of the machine; the same bits on every machine.
#pragma once

#include "sim/plan.h"

namespace hooke {

// Adds every spring's force [N] to f; with dashpots when `v` is given.
void add_spring_forces(const Plan& plan, const double* x, const double* v, double* f);

}  // namespace hooke
