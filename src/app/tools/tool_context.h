// What the tools and the other parts of the window share: the laboratory, its latest status, the selection, the camera.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "draw/camera.h"
#include "edit/copy_selection.h"
#include "lab/lab_thread.h"
#include "scene/pick.h"
#include "ui/keys.h"
#include "ui/layout.h"

namespace hooke {

struct Pointer {
  glm::dvec2 at{0.0};  // [px], in the scene's view
  Modifiers modifiers;
  bool twice = false;  // the second press of a double click
};

struct ToolContext {
  LabThread& lab;
  std::shared_ptr<const Status> status;
  Camera camera;
  Selection selection{};
  Gesture last_gesture = 0;
  Layout layout{};       // areas of the window
  glm::dvec2 size{1.0};  // [px], size of the scene's view
  double scale = 1.0;    // pixels per unit of design
  bool shows_surface = true;
  std::string notice{};                                // why a tool did nothing, until it is shown
  std::chrono::steady_clock::time_point frame_seen{};  // when the last frame was, or the scene was paused
  std::chrono::milliseconds patience{50};              // the maximum time that an event waits for the previous one to take effect

  const Snapshot& snapshot() const { return *status->snapshot; }
  const System& system() const { return *snapshot().system; }
  ViewTransform view_transform() const { return {camera.projection_matrix(size.x / size.y) * camera.view_matrix(), size, shows_surface}; }

  // [m], at the target of the camera.
  double view_height() const { return camera.meters_per_pixel(camera.target, size) * size.y; }

  // Reads the latest status; removed items are deselected.
  void take_status();
  // Waits for a moment until the laboratory has handled what was submitted, and reads its status. Returns false if it is not finished.
  bool settle();
  // Notes that the collider fits between the points of what it should stop.
  void note_gaps(const Collider& collider);

  // Under the cursor or within picking distance.
  std::optional<PointId> point_at(const glm::dvec2& cursor) const;
  std::optional<SpringId> spring_at(const glm::dvec2& cursor) const;
  // On the surface, if surfaces are shown.
  std::optional<SurfaceHit> surface_at(const glm::dvec2& cursor) const;
  std::optional<ColliderHit> collider_at(const glm::dvec2& cursor) const;

  // The cursor projected into the plane through `through` that faces the viewer, or into the plane of a 2-D scene.
  Vec3 point_in_view_plane(const glm::dvec2& cursor, const Vec3& through) const;
  // Position of a new point of this radius: on the sphere or box under the cursor, or on a plane that is nearer than the camera's
  // target; else in the view plane of the target.
  // With Ctrl on the grid.
  Vec3 place_for_point(const Pointer& pointer, double radius) const;
  // Position of a new point that is attached to one at `from`: in its view plane; with Ctrl on the grid.
  Vec3 place_beside(const Pointer& pointer, const Vec3& from) const;
  // The nearest intersection of the drawn grid.
  Vec3 on_grid(const Vec3& place) const;

  // Whether the cursor moved too far for a click.
  bool is_drag(const glm::dvec2& from, const glm::dvec2& to) const;

  Gesture begin_gesture() { return ++last_gesture; }
  IdSource new_ids() {
    return {[&from = lab] { return from.new_point_id(); }, [&from = lab] { return from.new_spring_id(); }};
  }
};

// The command that removes a collider.
SetColliders removal_of_collider(Index collider, const ToolContext& context);

}  // namespace hooke
