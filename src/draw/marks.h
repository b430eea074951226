// Selection, hover and previews, drawn over the scene. Plain data.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/color.h"
#include "base/types.h"
#include "scene/crossed_parts.h"

namespace hooke {

// The network with other positions of its points.
struct GhostNetwork {
  std::shared_ptr<const std::vector<Vec3>> positions;  // [m], one for each point
  Color color{};
};

// Vectors at points, drawn as arrows.
struct Arrows {
  enum class Kind { Velocity, Force, Load };
  Kind kind;
  double scale = 0.0;                        // [s] or [m/N], lengths by which the vectors are multiplied
  std::vector<std::pair<Vec3, Vec3>> lines;  // [m], from tail to tip
};

struct Marks {
  std::vector<PointId> selected_points;
  std::vector<SpringId> selected_springs;
  std::optional<PointId> hovered_point;
  std::optional<SpringId> hovered_spring;
  std::optional<Index> hovered_collider;
  std::optional<PointId> failed_point;  // where a run diverged
  std::optional<SpringId> failed_spring;
  std::shared_ptr<const CrossedParts> crossed;        // passing through each other or overlapping; null: none
  std::optional<Vec3> ghost_point;                    // where a click would add a point
  std::optional<std::pair<Vec3, Vec3>> ghost_spring;  // the line of an attachment or of a drag with a spring
  std::vector<std::pair<Vec3, Vec3>> ghost_lines;     // springs of a placement preview
  std::vector<Vec3> ghost_nails;                      // nails of a placement preview
  std::vector<GhostNetwork> ghost_networks;           // the first is on top
  std::vector<Arrows> arrows;
};

}  // namespace hooke
