// A leak of the gas in closed surfaces that is changed in a run.
#pragma once

#include <span>

#include "sim/model/system.h"

namespace hooke {

// Where the leak of a pressure is changed at `time` [s], but not its start: what has leaked until then is gone, and the new one acts from
// then on. The pressure becomes what is left. Before the start of the leak, and of other forces: nothing.
void continue_leak(const Force& before, double time, Force& after);

// A force before and after its leak was changed so.
struct LeakChange {
  Force before, after;
};

// Whether `after` continues the leak of `before`.
bool is_leak_continued(const Force& before, const Force& after);

// The force `now` at a `time` [s] before these changes, given in their order: what leaked after that time is back. The leak and what else
// was changed stay.
Force before_leaks(const Force& now, double time, std::span<const LeakChange> changes);

}  // namespace hooke
