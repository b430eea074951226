// Whether a run gives memory back between frames.
#pragma once

#include <cstddef>

namespace hooke {

// From this number of points on, memory counts more than the time that it takes to allocate it again: a laboratory without a start, and the
// monitor of a run, keep nothing between frames that can be computed again.
inline constexpr std::size_t min_points_of_large_run = 100'000;

}  // namespace hooke
