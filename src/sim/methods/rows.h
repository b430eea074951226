// Declarations of the integrators of list.inc. Each file of this folder defines one of them.
#pragma once

#include "sim/methods/integrator.h"

namespace hooke {

#define ROW(name) extern const Integrator name;
#include "sim/methods/list.inc"
#undef ROW

}  // namespace hooke
