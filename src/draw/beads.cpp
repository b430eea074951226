#include "draw/beads.h"

#include <algorithm>
#include <cstddef>

#include "draw/shader.h"

namespace hooke {

Beads::Beads()
    : stream_({{4, GL_FLOAT, GL_FALSE, offsetof(Vertex, x)},
               {4, GL_FLOAT, GL_FALSE, offsetof(Vertex, across)},
               {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, body)},
               {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, ring_ink)},
               {1, GL_FLOAT, GL_FALSE, offsetof(Vertex, square)}},
              sizeof(Vertex)) {}

void Beads::add(const Projection& projection, const glm::dvec4& clip, const Seen& seen, const Bead& bead) {
  // not before, behind or beyond the clip planes, nor further to the side than its own size
  if (seen.outside & (before | beyond | not_a_place)) return;
  const float reach = std::max(bead.radius, bead.ring) + 1.0f;
  if (seen.x < -reach || seen.x > static_cast<float>(projection.width()) + reach) return;
  if (seen.y < -reach || seen.y > static_cast<float>(projection.height()) + reach) return;

  const float front = std::max(projection.depth(clip, bead.radius / seen.scale), -1.0f);
  for (const float upward : {-reach, reach})
    for (const float across : {-reach, reach})
      vertices_.push_back({seen.x + across, seen.y + upward, seen.depth, front, across, upward, bead.radius, bead.ring, bead.body,
                           bead.ring_ink, bead.square ? 1.0f : 0.0f});
}

void Beads::draw(const Shader& shader, int width, int height, double scale) {
  shader.use();
  glUniform2f(shader.uniform("picture"), static_cast<float>(width), static_cast<float>(height));
  glUniform1f(shader.uniform("ring_width"), static_cast<float>(1.75 * scale));
  stream_.draw_quads(vertices_.data(), vertices_.size());
}

}  // namespace hooke
