// Progress of long reads and writes.
#pragma once

#include <cstddef>
#include <functional>

namespace hooke {

// Receives the fraction of the work that is done, 0 to 1; returns false to cancel. Empty: no progress is reported.
using Progress = std::function<bool(double fraction)>;

// Whether to report progress at this item: a call for each would take longer than the item itself.
constexpr bool is_progress_step(std::size_t item) { return item % 1024 == 1023; }

}  // namespace hooke
