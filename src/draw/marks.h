// What the person is doing, to be drawn over the scene. Plain data.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "base/types.h"

namespace hooke {

struct Marks {
  std::vector<PointId> selected_points;
  std::vector<SpringId> selected_springs;
  std::optional<PointId> hovered_point;
  std::optional<SpringId> hovered_spring;
  std::optional<Index> hovered_collider;
  std::optional<Vec3> ghost_point;                    // where a click would put one
  std::optional<std::pair<Vec3, Vec3>> ghost_spring;  // the rubber line of an attachment or a pull
  std::vector<std::pair<Vec3, Vec3>> ghost_lines;     // springs of what is about to be placed
  std::vector<Vec3> ghost_nails;                      // and its nails
};

}  // namespace hooke
