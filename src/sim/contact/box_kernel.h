// Which of many bounding boxes are close to each other, by vectors.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/system.h"

namespace hooke {

// Boxes, and so many after them that whole vectors can be read.
struct BoxColumns {
  static constexpr std::size_t padding = 8;
  std::array<std::vector<double>, 3> min, max;  // [m]

  void resize(std::size_t count) {
    for (int c = 0; c < 3; ++c) min[c].resize(count + padding), max[c].resize(count + padding);
  }
  void set(std::size_t i, const Vec3& low, const Vec3& high) {
    for (int c = 0; c < 3; ++c) min[c][i] = low[c], max[c][i] = high[c];
  }
};

struct BoxRange {
  Index begin = 0, end = 0;
};

// The pairs of a box in the first and one in the second range, in order, whose distance in each component is at most `reach` [m]; of the
// same boxes, those with the lower index first. `close` must have room for all pairs. Returns their number.
std::size_t find_close_boxes(const BoxColumns& first, BoxRange in_first, const BoxColumns& second, BoxRange in_second, double reach,
                             std::span<std::array<Index, 2>> close);

}  // namespace hooke
