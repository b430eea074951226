#include "draw/parts/point_impostors.h"

#include <algorithm>
#include <cstddef>

#include "draw/gl/shader.h"

namespace hooke {

PointImpostors::PointImpostors()
    : stream_({{4, GL_FLOAT, GL_FALSE, offsetof(Vertex, x)},
               {4, GL_FLOAT, GL_FALSE, offsetof(Vertex, across)},
               {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, body)},
               {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, ring_color)},
               {1, GL_FLOAT, GL_FALSE, offsetof(Vertex, square)}},
              sizeof(Vertex)) {}

void PointImpostors::add(const Projection& projection, const glm::dvec4& clip, const ProjectedPoint& projected,
                         const PointImpostor& impostor) {
  // Skip points outside the clip planes, or farther outside the picture than their own size.
  if (projected.outside & (Before | Beyond | NotFinite)) return;
  const float reach = std::max(impostor.radius, impostor.ring) + 1.0f;
  if (projected.x < -reach || projected.x > static_cast<float>(projection.width()) + reach) return;
  if (projected.y < -reach || projected.y > static_cast<float>(projection.height()) + reach) return;

  const float front = std::max(projection.depth(clip, impostor.radius / projected.scale), -1.0f);
  for (const float upward : {-reach, reach})
    for (const float across : {-reach, reach})
      vertices_.push_back({projected.x + across, projected.y + upward, projected.depth, front, across, upward, impostor.radius,
                           impostor.ring, impostor.body, impostor.ring_color, impostor.square ? 1.0f : 0.0f});
}

void PointImpostors::draw(const Shader& shader, int width, int height, double scale) {
  shader.use();
  glUniform2f(shader.uniform("picture"), static_cast<float>(width), static_cast<float>(height));
  glUniform1f(shader.uniform("ring_width"), static_cast<float>(1.75 * scale));
  stream_.draw_quads(vertices_.data(), vertices_.size());
}

}  // namespace hooke
