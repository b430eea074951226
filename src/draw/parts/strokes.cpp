#include "draw/parts/strokes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

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

// The projections of the ends of what is in the picture of a line between two clip coordinates; none: nothing, or an end is not finite.
using Ends = std::array<ProjectedPoint, 2>;
std::optional<Ends> project_in_picture(const Projection& projection, glm::dvec4 a, glm::dvec4 b) {
  if ((projection.project(a).outside | projection.project(b).outside) & NotFinite || !cut_to_picture(a, b)) return std::nullopt;
  return Ends{projection.project(a), projection.project(b)};
}

}  // namespace

Strokes::Strokes()
    : stream_({{3, GL_FLOAT, GL_FALSE, offsetof(Vertex, x)},
               {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, rgba)},
               {2, GL_SHORT, GL_FALSE, offsetof(Vertex, across)}},
              sizeof(Vertex)) {}

void Strokes::add(const Projection& projection, const glm::dvec4& a, const ProjectedPoint& projected_a, const glm::dvec4& b,
                  const ProjectedPoint& projected_b, Rgba rgba, float width) {
  if ((projected_a.outside | projected_b.outside) == 0) return add_projected(projected_a, projected_b, rgba, width);
  if ((projected_a.outside & projected_b.outside) != 0) return;
  if (const auto ends = project_in_picture(projection, a, b)) add_projected((*ends)[0], (*ends)[1], rgba, width);
}

void Strokes::add(const Projection& projection, const Vec3& a, const Vec3& b, Rgba rgba, float width, double depth_offset) {
  const auto lifted = [&](const glm::dvec4& clip) { return projection.moved_nearer(clip, depth_offset / projection.scale(clip)); };
  const glm::dvec4 start = lifted(projection.clip(a)), end = lifted(projection.clip(b));
  add(projection, start, projection.project(start), end, projection.project(end), rgba, width);
}

void Strokes::add_dashed(const Projection& projection, const Vec3& a, const Vec3& b, Rgba rgba, float width, float dash, float gap) {
  const auto ends = project_in_picture(projection, projection.clip(a), projection.clip(b));
  if (!ends) return;
  const auto& [from, to] = *ends;
  const float length = std::hypot(to.x - from.x, to.y - from.y);
  const auto at = [&, &start = from, &end = to](float t) {
    return ProjectedPoint{
        .x = std::lerp(start.x, end.x, t), .y = std::lerp(start.y, end.y, t), .depth = std::lerp(start.depth, end.depth, t)};
  };
  for (float s = 0.0f; s < length; s += dash + gap) add_projected(at(s / length), at(std::min(s + dash, length) / length), rgba, width);
}

void Strokes::add_arrow(const Projection& projection, const Vec3& a, const Vec3& b, Rgba rgba, float width, float head) {
  const auto ends = project_in_picture(projection, projection.clip(a), projection.clip(b));
  if (!ends) return;
  const auto& [from, to] = *ends;
  const float dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
  if (length < 1.5f * width) return;
  add_projected(from, to, rgba, width);
  const float back = std::min(head, 0.6f * length) / length, side = 0.45f * back;
  for (const float turn : {side, -side})
    add_projected(to, {.x = to.x - back * dx - turn * dy, .y = to.y - back * dy + turn * dx, .depth = to.depth}, rgba, width);
}

void Strokes::add_projected(const ProjectedPoint& a, const ProjectedPoint& b, Rgba rgba, float width) {
  const float dx = b.x - a.x, dy = b.y - a.y;
  const float length = std::sqrt(dx * dx + dy * dy);
  if (!(length > 1e-3f)) return;

  // Half a pixel more on each side for antialiasing.
  const float reach = 0.5f * width + 0.5f;
  const float nx = -dy / length * reach, ny = dx / length * reach;
  const auto across = static_cast<std::int16_t>(256.0f * reach), half = static_cast<std::int16_t>(128.0f * width);
  const auto other = static_cast<std::int16_t>(-across);
  for (const ProjectedPoint* end : {&a, &b}) {
    vertices_.push_back({end->x + nx, end->y + ny, end->depth, rgba, across, half});
    vertices_.push_back({end->x - nx, end->y - ny, end->depth, rgba, other, half});
  }
}

void Strokes::draw(const Shader& shader, int width, int height) {
  shader.use();
  glUniform2f(shader.uniform("picture"), static_cast<float>(width), static_cast<float>(height));
  stream_.draw_quads(vertices_.data(), vertices_.size());
}

}  // namespace hooke
