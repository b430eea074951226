// Selection, hover and previews, drawn over the scene. Plain data.
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
  std::optional<Vec3> ghost_point;                    // where a click would add a point
  std::optional<std::pair<Vec3, Vec3>> ghost_spring;  // the line of an attachment or of a drag with a spring
  std::vector<std::pair<Vec3, Vec3>> ghost_lines;     // springs of a placement preview
  std::vector<Vec3> ghost_nails;                      // nails of a placement preview
};

}  // namespace hooke
