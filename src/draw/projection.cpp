#include "draw/projection.h"

#include <cmath>

namespace hooke {

Projection::Projection(const Camera& camera, int width, int height)
    : target_(camera.target),
      distance_(camera.distance),
      rotation_(glm::dmat3(camera.view_matrix())),
      projection_(camera.projection_matrix(static_cast<double>(width) / height)),
      pixels_(0.5 * height * projection_[1][1]),
      orthographic_(camera.orthographic),
      width_(width),
      height_(height) {}

glm::dvec4 Projection::clip_from_view(const Vec3& view_position) const {
  const double z = projection_[2][2] * view_position.z + projection_[3][2];
  return {projection_[0][0] * view_position.x, projection_[1][1] * view_position.y, z, orthographic_ ? 1.0 : -view_position.z};
}

ProjectedPoint Projection::project(const glm::dvec4& clip) const {
  // Positions beyond the range of single precision are not finite either.
  if (!(std::abs(clip.x) + std::abs(clip.y) + std::abs(clip.z) < 1e30)) return {.outside = NotFinite};
  ProjectedPoint projected;
  projected.outside =
      static_cast<std::uint8_t>((clip.x < -clip.w ? LeftOf : 0) | (clip.x > clip.w ? RightOf : 0) | (clip.y < -clip.w ? Below : 0) |
                                (clip.y > clip.w ? Above : 0) | (clip.z < -clip.w ? Before : 0) | (clip.z > clip.w ? Beyond : 0));
  if (!(clip.w > 0.0)) return projected;
  projected.x = static_cast<float>((clip.x / clip.w + 1.0) * 0.5 * width_);
  projected.y = static_cast<float>((clip.y / clip.w + 1.0) * 0.5 * height_);
  projected.depth = static_cast<float>(clip.z / clip.w);
  projected.scale = static_cast<float>(scale(clip));
  return projected;
}

glm::dvec4 Projection::moved_nearer(const glm::dvec4& clip, double nearer) const {
  const double w = orthographic_ ? 1.0 : clip.w - nearer;
  if (!(w > 0.0)) return clip;
  return {clip.x, clip.y, (clip.z + projection_[2][2] * nearer) / w * clip.w, clip.w};
}

float Projection::depth(const glm::dvec4& clip, double nearer) const { return static_cast<float>(moved_nearer(clip, nearer).z / clip.w); }

}  // namespace hooke
