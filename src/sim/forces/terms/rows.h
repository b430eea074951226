// Declarations of the force terms of list.inc. Each file of this folder defines one of them.
#pragma once

#include "sim/model/force_term.h"

namespace hooke {

#define ROW(name) extern const ForceTerm name;
#include "sim/forces/terms/list.inc"
#undef ROW

}  // namespace hooke
