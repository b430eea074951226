// Projects positions with a camera. Computed on the CPU in double precision, relative to the target of the camera, so that scenes far from
// the origin look the same as at the origin and every driver draws the same widths.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "draw/camera.h"

namespace hooke {

// A projected position. Pixels count from the lower left corner of the picture.
struct ProjectedPoint {
  float x = 0.0f, y = 0.0f;  // [px]
  float depth = 0.0f;        // in -1..1 between the clip planes
  float scale = 0.0f;        // [px/m] at this depth
  // Bits of `Outside`: the sides of the view volume that the position is beyond; 0: inside.
  std::uint8_t outside = 0;
};

enum Outside : std::uint8_t { LeftOf = 1, RightOf = 2, Below = 4, Above = 8, Before = 16, Beyond = 32, NotFinite = 64 };

class Projection {
 public:
  Projection(const Camera& camera, int width, int height);

  // Homogeneous clip coordinates; not finite if the position is not.
  glm::dvec4 clip(const Vec3& place) const { return clip_from_view(view_position(place)); }
  glm::dvec4 clip_from_view(const Vec3& view_position) const;
  ProjectedPoint project(const glm::dvec4& clip) const;
  ProjectedPoint project(const Vec3& place) const { return project(clip(place)); }

  // Depth of a position `nearer` [m] closer to the viewer than these clip coordinates.
  float depth(const glm::dvec4& clip, double nearer) const;
  // The same position in the picture, `nearer` [m] closer to the viewer.
  glm::dvec4 moved_nearer(const glm::dvec4& clip, double nearer) const;
  // [px/m] at clip coordinates.
  double scale(const glm::dvec4& clip) const { return pixels_ / clip.w; }
  // A direction in view coordinates: x right, y up, z towards the viewer.
  Vec3 view_direction(const Vec3& direction) const { return rotation_ * direction; }
  // A position in view coordinates [m]: the eye at the origin, z towards the viewer.
  Vec3 view_position(const Vec3& place) const { return rotation_ * (place - target_) - Vec3(0.0, 0.0, distance_); }

  const glm::dmat4& matrix() const { return projection_; }
  bool is_orthographic() const { return orthographic_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  Vec3 target_;
  double distance_;
  glm::dmat3 rotation_;
  glm::dmat4 projection_;  // from view to clip coordinates
  double pixels_;          // [px] per meter at w = 1
  bool orthographic_;
  int width_, height_;
};

}  // namespace hooke
