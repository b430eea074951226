// A leak of the gas in closed surfaces that is changed in a run.
#pragma once

#include "sim/system.h"

namespace hooke {

// Where the leak of a pressure is changed at `time` [s], but not its start: what has leaked until then is gone, and the new one acts from
// then on. The pressure becomes what is left. Before the start of the leak, and of other forces: nothing.
void continue_leak(const Force& before, double time, Force& after);

}  // namespace hooke
