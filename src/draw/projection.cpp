#include "draw/projection.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace hooke {

Projection::Projection(const Camera& camera, int width, int height)
    : target_(camera.target),
      distance_(camera.distance),
      turn_(glm::dmat3(camera.view_matrix())),
      projection_(camera.projection_matrix(static_cast<double>(width) / height)),
      pixels_(0.5 * height * projection_[1][1]),
      orthographic_(camera.orthographic),
      width_(width),
      height_(height) {}

glm::dvec4 Projection::clip(const Vec3& place) const {
  const Vec3 p = viewed(place);
  const double z = projection_[2][2] * p.z + projection_[3][2];
  return {projection_[0][0] * p.x, projection_[1][1] * p.y, z, orthographic_ ? 1.0 : -p.z};
}

Seen Projection::see(const glm::dvec4& clip) const {
  if (!std::isfinite(clip.x + clip.y + clip.z)) return {.outside = not_a_place};
  Seen seen;
  seen.outside =
      static_cast<std::uint8_t>((clip.x < -clip.w ? left_of : 0) | (clip.x > clip.w ? right_of : 0) | (clip.y < -clip.w ? below : 0) |
                                (clip.y > clip.w ? above : 0) | (clip.z < -clip.w ? before : 0) | (clip.z > clip.w ? beyond : 0));
  if (!(clip.w > 0.0)) return seen;
  seen.x = static_cast<float>((clip.x / clip.w + 1.0) * 0.5 * width_);
  seen.y = static_cast<float>((clip.y / clip.w + 1.0) * 0.5 * height_);
  seen.depth = static_cast<float>(clip.z / clip.w);
  seen.scale = static_cast<float>(scale(clip));
  return seen;
}

float Projection::depth(const glm::dvec4& clip, double nearer) const {
  const double w = orthographic_ ? 1.0 : clip.w - nearer;
  return w > 0.0 ? static_cast<float>((clip.z + projection_[2][2] * nearer) / w) : -1.0f;
}

}  // namespace hooke
