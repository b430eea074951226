// A perspective or orthographic camera that looks at a target. Plain data and arithmetic: no OpenGL.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "scene/view_settings.h"
#include "sim/snapshot.h"

namespace hooke {

// A half-line, direction of unit length.
struct Ray {
  Vec3 origin{0.0}, direction{0.0, 0.0, -1.0};
};

struct Camera {
  Vec3 target{0.0};
  Vec3 back{0.0, 0.0, 1.0};    // unit, from the target to the eye
  Vec3 up{0.0, 1.0, 0.0};      // unit, normal to back: of the picture
  Vec3 pole{0.0, 1.0, 0.0};    // unit: the world's up, about which an orbit turns
  double distance = 3.0;       // [m]
  double field_of_view = 0.7;  // [rad], vertical
  bool orthographic = false;
  bool follows = false;  // follow_scene moves it

  Vec3 eye() const { return target + distance * back; }
  glm::dmat4 view_matrix() const;
  glm::dmat4 projection_matrix(double aspect) const;

  // Through a place of the picture; cursor and size in the same unit, origin at the top left.
  Ray ray_through(const glm::dvec2& cursor, const glm::dvec2& size) const;
  // Where a point of the world is seen; z is the depth in [0, 1] within the clip planes, outside them when behind.
  Vec3 project(const Vec3& world, const glm::dvec2& size) const;
  // Where the ray through the cursor meets the plane through `through` that faces the viewer.
  Vec3 unproject(const glm::dvec2& cursor, const glm::dvec2& size, const Vec3& through) const;
  // [m] per pixel at a place of the world.
  double metres_per_pixel(const Vec3& at, const glm::dvec2& size) const;

  void orbit(double yaw, double pitch);  // [rad]
  // Level, towards the person who sees the scene from its front.
  Vec3 front() const;
  // Sees the target from this direction, upright; from above and below the front is at the bottom of the picture.
  void look_from(const Vec3& direction);
  void pan(const glm::dvec2& from, const glm::dvec2& to, const glm::dvec2& size);
  // factor < 1 comes nearer; what is under the cursor stays under it.
  void zoom(double factor, const glm::dvec2& cursor, const glm::dvec2& size);
};

// As a scene asks for it; without a pose, so that all of it is seen: 2-D scenes from the front, 3-D a little from above.
Camera make_camera(const ViewSettings& view, const System& system, const State& state, double aspect);
CameraPose pose_of(const Camera& camera);

// Keeps the direction and moves so that the whole scene (or these points) is seen.
void frame_scene(Camera& camera, const System& system, const State& state, double aspect);

// Moves a camera that follows, as little as it takes to have the middle of all points near the middle of the picture.
void follow_scene(Camera& camera, const State& state);

}  // namespace hooke
