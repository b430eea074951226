// A perspective or orthographic camera that looks at a target. Plain data and arithmetic: no OpenGL.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "scene/view_settings.h"
#include "sim/step/snapshot.h"

namespace hooke {

// A half-line, direction of unit length.
struct Ray {
  Vec3 origin{0.0}, direction{0.0, 0.0, -1.0};
};

struct Camera {
  Vec3 target{0.0};
  Vec3 back{0.0, 0.0, 1.0};    // unit, from the target to the eye
  Vec3 up{0.0, 1.0, 0.0};      // unit, normal to back: up in the picture
  Vec3 pole{0.0, 1.0, 0.0};    // unit: up in the world, the axis of an orbit
  double distance = 3.0;       // [m]
  double field_of_view = 0.7;  // [rad], vertical
  bool orthographic = false;
  bool follows = false;  // moved by follow_scene

  Vec3 eye() const { return target + distance * back; }
  glm::dmat4 view_matrix() const;
  glm::dmat4 projection_matrix(double aspect) const;

  // The ray through a position in the picture; cursor and size in the same unit, origin at the top left.
  Ray ray_through(const glm::dvec2& cursor, const glm::dvec2& size) const;
  // Projects a point of the world to the picture; z is the depth, in [0, 1] between the clip planes and outside that range elsewhere.
  Vec3 project(const Vec3& world, const glm::dvec2& size) const;
  // Where the ray through the cursor meets the plane through `through` that faces the viewer.
  Vec3 unproject(const glm::dvec2& cursor, const glm::dvec2& size, const Vec3& through) const;
  // [m] per pixel at a point of the world.
  double meters_per_pixel(const Vec3& at, const glm::dvec2& size) const;

  void orbit(double yaw, double pitch);  // [rad]
  // Horizontal, from the scene towards a viewer in front of it.
  Vec3 front() const;
  // Views the target from this direction, upright. From above and below, the front is at the bottom of the picture.
  void look_from(const Vec3& direction);
  void pan(const glm::dvec2& from, const glm::dvec2& to, const glm::dvec2& size);
  // factor < 1 zooms in. The point under the cursor stays under it.
  void zoom(double factor, const glm::dvec2& cursor, const glm::dvec2& size);
};

// Distance of the lines of the grid as it is seen from there [m]: a power of ten.
double grid_spacing(const Camera& camera);

// The camera pose of the view settings, or one that shows the whole scene: 2-D scenes from the front, 3-D scenes slightly from above.
Camera make_camera(const ViewSettings& view, const System& system, const State& state, double aspect);
// The same for a scene as it is opened: in a picture narrower than 16:10 its pose is taken from farther away, so that nothing is cut off at
// the sides.
Camera make_scene_camera(const ViewSettings& view, const System& system, const State& state, double aspect);
CameraPose pose_of(const Camera& camera);

// Moves the camera, without turning it, so that the whole scene is visible.
void frame_scene(Camera& camera, const System& system, const State& state, double aspect);

// Moves a following camera just enough to keep the mean of all points near the center of the picture.
void follow_scene(Camera& camera, const State& state);

}  // namespace hooke
