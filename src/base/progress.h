// What a long reading or writing tells the one who waits for it.
#pragma once

#include <cstddef>
#include <functional>

namespace hooke {

// Told the share of the work that is done, from 0 to 1, now and then; false: it is not wanted any more. Empty: nobody asks.
using Progress = std::function<bool(double share)>;

// Whether work at this item of many should tell how far it is: a call for each would take longer than the item.
constexpr bool is_progress_step(std::size_t item) { return item % 1024 == 1023; }

}  // namespace hooke
