// Which of many numbers are low, by vectors.
#pragma once

#include <span>
#include <vector>

#include "sim/model/system.h"

namespace hooke {

// Some of the keys, which belong together.
struct KeyRange {
  Index begin = 0, end = 0, group = 0;
  double limit = 0.0, min = 0.0;
};
struct KeyPlace {
  Index key = 0, group = 0;
};
// Vectors read this many keys beyond the last range.
inline constexpr std::size_t key_padding = 8;

// The places of the keys below the limits of their ranges, in order, replace the first of `places`, which grows as needed; returns how many
// there are. The minima become those of the keys of their ranges where these are less.
std::size_t find_below(std::span<const double> keys, std::span<KeyRange> ranges, std::vector<KeyPlace>& places);

}  // namespace hooke
