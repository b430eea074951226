// The line along which ropes and chains hang: straight, or a V if the distance of the ends is smaller than the length.
#pragma once

#include <algorithm>
#include <cmath>

#include "scene/shape.h"

namespace hooke {

inline constexpr std::string_view line_supports[] = {"one_end", "both_ends", "nothing"};

// The position at the fraction u of the length.
inline Vec3 place_on_line(const Shape& shape, double u) {
  const double length = shape["length"], span = shape.support_name() == "both_ends" ? std::min(shape["span"], length) : length;
  const double depth = 0.5 * std::sqrt(std::max(0.0, length * length - span * span));
  return {(u - 0.5) * span, 0.5 * depth - depth * (1.0 - std::abs(2.0 * u - 1.0)), 0.0};
}

inline bool is_end_nailed(const Shape& shape, bool is_first, bool is_last) {
  return (is_first && shape.support_name() != "nothing") || (is_last && shape.support_name() == "both_ends");
}

}  // namespace hooke
