// Finds what is visible under the cursor.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "sim/step/snapshot.h"

namespace hooke {

// The projection of the world to the picture. Cursors are in the unit of `size`, from the top left of the picture.
struct ViewTransform {
  glm::dmat4 clip{1.0};        // world to clip coordinates: projection * view
  glm::dvec2 size{1.0};        // [px]
  bool shows_surface = false;  // faces hide what is behind them
};

struct PickRay {
  Vec3 origin{0.0}, direction{0.0, 0.0, -1.0};  // direction of unit length, away from the viewer
  Vec3 at(double distance) const { return origin + distance * direction; }
};

// The ray from the viewer through this position of the picture. Starts at the near plane.
PickRay pick_ray(const ViewTransform& view_transform, const glm::dvec2& cursor);

// The position of a point of the world in the picture; none if it is behind the viewer.
std::optional<glm::dvec2> project_to_screen(const ViewTransform& view_transform, const Vec3& place);

// The first intersection of the ray with a solid collider from outside, at `time` [s].
struct ColliderHit {
  double distance;  // [m], along the ray
  Vec3 position, normal;
  bool bounded;  // a sphere or a box, not an infinite plane
  Index collider = no_index;
};
std::optional<ColliderHit> hit_collider(const System& system, const State& state, const PickRay& ray);

// The visible solid collider at the cursor, not behind the surface if that is shown. In a 2-D scene the collider that
// contains the cursor in the plane of the scene.
std::optional<ColliderHit> pick_collider(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& cursor);

// The point whose sphere is under the cursor, or else the nearest within `reach` [px]. Points behind a collider, or behind
// the surface if that is shown, are ignored.
std::optional<PointId> pick_point(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& cursor,
                                  double pick_radius);

// The first intersection of the ray with a face, in front of every collider.
struct SurfaceHit {
  Patch patch;
  Vec3 position{0.0};
};
std::optional<SurfaceHit> pick_surface(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& cursor);

// The spring nearest to the cursor within `reach` [px].
std::optional<SpringId> pick_spring(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& cursor,
                                    double pick_radius);

// Points within a closed outline in the picture, in ascending order of their ids.
std::vector<PointId> points_within(const Snapshot& snapshot, const ViewTransform& view_transform, const std::vector<glm::dvec2>& outline);

// Springs that the path of the cursor from `from` to `to` crosses in the picture.
std::vector<SpringId> springs_across(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& from,
                                     const glm::dvec2& to);

}  // namespace hooke
