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

glm::dvec4 Projection::clip_viewed(const Vec3& viewed) const {
  const double z = projection_[2][2] * viewed.z + projection_[3][2];
  return {projection_[0][0] * viewed.x, projection_[1][1] * viewed.y, z, orthographic_ ? 1.0 : -viewed.z};
}

Seen Projection::see(const glm::dvec4& clip) const {
  // nor is what single precision cannot hold
  if (!(std::abs(clip.x) + std::abs(clip.y) + std::abs(clip.z) < 1e30)) return {.outside = not_a_place};
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

glm::dvec4 Projection::moved_nearer(const glm::dvec4& clip, double nearer) const {
  const double w = orthographic_ ? 1.0 : clip.w - nearer;
  if (!(w > 0.0)) return clip;
  return {clip.x, clip.y, (clip.z + projection_[2][2] * nearer) / w * clip.w, clip.w};
}

float Projection::depth(const glm::dvec4& clip, double nearer) const { return static_cast<float>(moved_nearer(clip, nearer).z / clip.w); }

}  // namespace hooke
