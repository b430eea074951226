// For tests that submit commands and look at the result.
#pragma once

#include "lab/lab.h"

namespace hooke {

// Applies all submitted commands without advancing time.
inline void apply_now(Lab& lab) {
  lab.advance(0.0, [] { return true; });
}

}  // namespace hooke
