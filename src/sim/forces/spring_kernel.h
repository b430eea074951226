// Spring forces, for the widest vector unit of the machine; the same bits on every machine.
#pragma once

#include "sim/plan/plan.h"

namespace hooke {

// Adds the force [N] of every spring to f, including dashpots if `v` is given.
void add_spring_forces(const Plan& plan, const double* x, const double* v, double* f);

// Those of the springs outside grids alone.
void add_loose_spring_forces(const Plan& plan, const double* x, const double* v, double* f);

}  // namespace hooke
