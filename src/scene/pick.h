// What is under the cursor. Works from a Snapshot and a ViewTransform; what is picked is what is seen.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "sim/snapshot.h"

namespace hooke {

// How the world becomes a picture. Cursors are in the unit of `size`, from the picture's top left.
struct ViewTransform {
  glm::dmat4 clip{1.0};        // world to clip coordinates: projection * view
  glm::dvec2 size{1.0};        // [px]
  bool shows_surface = false;  // faces hide what is behind them
};

struct PickRay {
  Vec3 origin{0.0}, direction{0.0, 0.0, -1.0};  // direction of unit length, away from the viewer
  Vec3 at(double distance) const { return origin + distance * direction; }
};

// Everything that is seen at this place of the picture. Starts at the near plane.
PickRay pick_ray(const ViewTransform& view_transform, const glm::dvec2& cursor);

// Where a place of the world is seen; none when it is behind the viewer.
std::optional<glm::dvec2> project_to_screen(const ViewTransform& view_transform, const Vec3& place);

// Where the line first meets a solid collider from outside, as they are at `time` [s].
struct ColliderHit {
  double distance;  // [m], along the line
  Vec3 position, normal;
  bool bounded;  // a sphere or a box, not an endless plane
  Index collider = no_index;
};
std::optional<ColliderHit> hit_collider(const System& system, const State& state, const PickRay& ray);

// The solid collider that is seen at the cursor, not behind the surface if it is shown. In a 2-D scene, that of which the
// inside lies under it in the scene's plane.
std::optional<ColliderHit> pick_collider(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& cursor);

// The point whose ball is seen under the cursor, else the nearest within `reach` [px] of it. Points behind a collider, or
// behind the surface if it is shown, are passed over.
std::optional<PointId> pick_point(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& cursor,
                                  double pick_radius);

// Where on a face the line of sight through the cursor first meets one, in front of every collider.
struct SurfaceHit {
  Patch patch;
  Vec3 position{0.0};
};
std::optional<SurfaceHit> pick_surface(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& cursor);

// The spring nearest to the cursor within `reach` [px].
std::optional<SpringId> pick_spring(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& cursor,
                                    double pick_radius);

// Points seen within the rectangle between two corners, in ascending order of their ids.
std::vector<PointId> points_in_box(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& corner,
                                   const glm::dvec2& opposite);

// Springs whose picture the cursor's way from `from` to `to` crosses.
std::vector<SpringId> springs_across(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& from,
                                     const glm::dvec2& to);

}  // namespace hooke
