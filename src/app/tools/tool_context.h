// What a tool works on: the laboratory, the selection, and the scene as it is seen.
#pragma once

#include <memory>
#include <optional>

#include "draw/camera.h"
#include "lab/lab_thread.h"
#include "scene/pick.h"
#include "scene/selection.h"

namespace hooke {

struct ToolContext {
  LabThread& lab;
  Selection& selection;
  Gesture& last_gesture;
  std::shared_ptr<const Status> status;
  Camera camera;
  glm::dvec2 size{1.0};  // [px], of the scene's picture
  double scale = 1.0;    // pixels per unit of design
  bool shows_surface = true;

  const Snapshot& snapshot() const { return *status->snapshot; }
  const System& system() const { return *snapshot().system; }
  ViewTransform view_transform() const { return {camera.projection_matrix(size.x / size.y) * camera.view_matrix(), size, shows_surface}; }

  // Under the cursor or within reach of it.
  std::optional<PointId> point_at(const glm::dvec2& cursor) const;
  std::optional<SpringId> spring_at(const glm::dvec2& cursor) const;
  // On the surface, if it is shown.
  std::optional<SurfaceHit> surface_at(const glm::dvec2& cursor) const;
  std::optional<ColliderHit> collider_at(const glm::dvec2& cursor) const;

  // Under the cursor: in the plane through `through` that faces the viewer, or in the plane of a 2-D scene.
  Vec3 point_in_view_plane(const glm::dvec2& cursor, const Vec3& through) const;
  // Where a new point of this radius goes: onto the ball or box under the cursor, or onto a plane that is nearer than the
  // camera's target; else beside the target.
  Vec3 place_for_point(const glm::dvec2& cursor, double radius) const;

  // A way of the cursor that is more than a click with an unsteady hand.
  bool is_drag(const glm::dvec2& from, const glm::dvec2& to) const;

  Gesture begin_gesture() { return ++last_gesture; }
};

}  // namespace hooke
