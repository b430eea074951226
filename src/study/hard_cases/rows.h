// Declarations of the hard cases of list.inc. The files of this folder define them, one file per family.
#pragma once

#include "study/hard_cases/hard_case.h"

namespace hooke {

#define ROW(name) extern const HardCase name;
#include "study/hard_cases/list.inc"
#undef ROW

}  // namespace hooke
