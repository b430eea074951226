// A mesh of polygons and lines as read from a file.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/types.h"

namespace hooke {

inline constexpr double largest_coordinate = 1e9;  // [m]

struct Mesh {
  std::vector<Vec3> vertices;               // [m]
  std::vector<Index> corners;               // vertices of all polygons, one polygon after the other
  std::vector<Index> polygon_ends;          // for each polygon, the index in `corners` past its last corner
  std::vector<std::array<Index, 2>> lines;  // between two vertices
  std::vector<Index> lone_points;           // vertices named as points

  std::size_t polygon_count() const { return polygon_ends.size(); }
  std::span<const Index> polygon(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : static_cast<std::size_t>(polygon_ends[i - 1]);
    return {corners.data() + begin, corners.data() + polygon_ends[i]};
  }
};

}  // namespace hooke
