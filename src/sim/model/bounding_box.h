// The box around positions.
#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <span>

#include "base/types.h"

namespace hooke {

struct BoundingBox {
  Vec3 min{0.0}, max{0.0};  // [m]
  Vec3 center() const { return 0.5 * (min + max); }
  double longest_side() const { return std::max({max.x - min.x, max.y - min.y, max.z - min.z}); }
};

// Zero without positions.
inline BoundingBox bounding_box(std::span<const Vec3> positions) {
  if (positions.empty()) return {};
  BoundingBox box{positions.front(), positions.front()};
  for (const Vec3& x : positions) box.min = glm::min(box.min, x), box.max = glm::max(box.max, x);
  return box;
}

}  // namespace hooke
