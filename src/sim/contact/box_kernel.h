// Which of many bounding boxes are close to each other, by vectors.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "base/types.h"

namespace hooke {

struct SurfaceBox {
  Vec3 min{0.0}, max{0.0};

  void include(const SurfaceBox& other) {
    min = {std::min(min.x, other.min.x), std::min(min.y, other.min.y), std::min(min.z, other.min.z)};
    max = {std::max(max.x, other.max.x), std::max(max.y, other.max.y), std::max(max.z, other.max.z)};
  }
};

// Boxes, and so many after them that whole vectors can be read.
struct SurfaceBoxes {
  static constexpr std::size_t padding = 8;
  std::array<std::vector<double>, 3> min, max;  // [m]

  void resize(std::size_t count) {
    for (int c = 0; c < 3; ++c) min[c].resize(count + padding), max[c].resize(count + padding);
  }
  void set(Index i, const SurfaceBox& box) {
    for (int c = 0; c < 3; ++c) min[c][i] = box.min[c], max[c][i] = box.max[c];
  }
};

struct BoxRange {
  Index begin = 0, end = 0;
};
// Some of the boxes, and one around them.
struct BoxSet {
  const SurfaceBoxes& boxes;
  BoxRange range;
  const SurfaceBox& bound;
};

// The pairs of a box in the first and one in the second set, in order, whose distance is at most `reach` [m], up to rounding; of the same
// set, those with the lower index first. `close` must have room for all pairs. Returns their number.
std::size_t find_close_boxes(const BoxSet& first, const BoxSet& second, double reach, std::span<std::array<Index, 2>> close);

}  // namespace hooke
