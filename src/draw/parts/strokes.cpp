#include "draw/parts/strokes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "draw/gl/shader.h"

namespace hooke {
namespace {

// Clips the segment from a to b to where `distance` is not negative, which holds for at least one end.
void cut(glm::dvec4& a, glm::dvec4& b, double at_a, double at_b) {
  if (at_a < 0.0) a += at_a / (at_a - at_b) * (b - a);
  if (at_b < 0.0) b += at_b / (at_b - at_a) * (a - b);
}

// Clips to the clip planes and slightly outside the sides of the picture, so that no cut end is visible. Returns false if
// nothing is left.
bool cut_to_picture(glm::dvec4& a, glm::dvec4& b) {
  constexpr double side = 1.1;
  const auto distance = [](const glm::dvec4& p, int border) {
    const double reach = (border < 4 ? side : 1.0) * p.w;
    return border % 2 == 0 ? reach + p[border / 2] : reach - p[border / 2];
  };
  for (const int border : {4, 5, 0, 1, 2, 3}) {
    const double at_a = distance(a, border), at_b = distance(b, border);
    if (at_a < 0.0 && at_b < 0.0) return false;
    cut(a, b, at_a, at_b);
  }
  return a.w > 0.0 && b.w > 0.0;
}

}  // namespace

Strokes::Strokes()
    : stream_({{3, GL_FLOAT, GL_FALSE, offsetof(Vertex, x)},
               {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, rgba)},
               {2, GL_SHORT, GL_FALSE, offsetof(Vertex, across)}},
              sizeof(Vertex)) {}

void Strokes::add(const Projection& projection, const glm::dvec4& a, const ProjectedPoint& projected_a, const glm::dvec4& b,
                  const ProjectedPoint& projected_b, Rgba rgba, float width) {
  if ((projected_a.outside | projected_b.outside) == 0)
    return add_projected(projected_a.x, projected_a.y, projected_a.depth, projected_b.x, projected_b.y, projected_b.depth, rgba, width);
  if ((projected_a.outside & projected_b.outside) != 0 || ((projected_a.outside | projected_b.outside) & NotFinite)) return;
  glm::dvec4 start = a, end = b;
  if (!cut_to_picture(start, end)) return;
  const ProjectedPoint from = projection.project(start), to = projection.project(end);
  add_projected(from.x, from.y, from.depth, to.x, to.y, to.depth, rgba, width);
}

void Strokes::add(const Projection& projection, const Vec3& a, const Vec3& b, Rgba rgba, float width, double depth_offset) {
  const auto lifted = [&](const glm::dvec4& clip) { return projection.moved_nearer(clip, depth_offset / projection.scale(clip)); };
  const glm::dvec4 start = lifted(projection.clip(a)), end = lifted(projection.clip(b));
  add(projection, start, projection.project(start), end, projection.project(end), rgba, width);
}

void Strokes::add_dashed(const Projection& projection, const Vec3& a, const Vec3& b, Rgba rgba, float width, float dash, float gap) {
  glm::dvec4 start = projection.clip(a), end = projection.clip(b);
  if ((projection.project(start).outside | projection.project(end).outside) & NotFinite) return;
  if (!cut_to_picture(start, end)) return;
  const ProjectedPoint from = projection.project(start), to = projection.project(end);
  const float length = std::hypot(to.x - from.x, to.y - from.y);
  for (float at = 0.0f; at < length; at += dash + gap) {
    const float s = at / length, t = std::min(at + dash, length) / length;
    add_projected(std::lerp(from.x, to.x, s), std::lerp(from.y, to.y, s), std::lerp(from.depth, to.depth, s), std::lerp(from.x, to.x, t),
                  std::lerp(from.y, to.y, t), std::lerp(from.depth, to.depth, t), rgba, width);
  }
}

void Strokes::add_arrow(const Projection& projection, const Vec3& a, const Vec3& b, Rgba rgba, float width, float head) {
  glm::dvec4 start = projection.clip(a), end = projection.clip(b);
  if ((projection.project(start).outside | projection.project(end).outside) & NotFinite) return;
  if (!cut_to_picture(start, end)) return;
  const ProjectedPoint from = projection.project(start), to = projection.project(end);
  const float dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
  if (length < 1.5f * width) return;
  add_projected(from.x, from.y, from.depth, to.x, to.y, to.depth, rgba, width);
  const float back = std::min(head, 0.6f * length) / length, side = 0.45f * back;
  for (const float turn : {side, -side})
    add_projected(to.x, to.y, to.depth, to.x - back * dx - turn * dy, to.y - back * dy + turn * dx, to.depth, rgba, width);
}

void Strokes::add_projected(float ax, float ay, float a_depth, float bx, float by, float b_depth, Rgba rgba, float width) {
  const float dx = bx - ax, dy = by - ay;
  const float length = std::sqrt(dx * dx + dy * dy);
  if (!(length > 1e-3f)) return;

  // Half a pixel more on each side for antialiasing.
  const float reach = 0.5f * width + 0.5f;
  const float nx = -dy / length * reach, ny = dx / length * reach;
  const auto across = static_cast<std::int16_t>(256.0f * reach), half = static_cast<std::int16_t>(128.0f * width);
  const auto other = static_cast<std::int16_t>(-across);
  vertices_.push_back({ax + nx, ay + ny, a_depth, rgba, across, half});
  vertices_.push_back({ax - nx, ay - ny, a_depth, rgba, other, half});
  vertices_.push_back({bx + nx, by + ny, b_depth, rgba, across, half});
  vertices_.push_back({bx - nx, by - ny, b_depth, rgba, other, half});
}

void Strokes::draw(const Shader& shader, int width, int height) {
  shader.use();
  glUniform2f(shader.uniform("picture"), static_cast<float>(width), static_cast<float>(height));
  stream_.draw_quads(vertices_.data(), vertices_.size());
}

}  // namespace hooke
