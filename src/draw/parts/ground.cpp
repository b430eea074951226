#include "draw/parts/ground.h"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "draw/gl/shader.h"

namespace hooke {
void span(const Vec3& normal, Vec3& across, Vec3& along) {
  const Vec3 axis = std::abs(normal.x) < 0.9 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 0.0, 1.0);
  across = glm::normalize(axis - glm::dot(axis, normal) * normal);
  along = glm::cross(normal, across);
}

bool is_before(const Camera& camera, const Plane& plane) {
  const Vec3 towards = camera.orthographic ? camera.back : camera.eye() - plane.point;
  return glm::dot(towards, plane.normal) > 0.0;
}

Ground::Ground()
    : stream_({{4, GL_FLOAT, GL_FALSE, offsetof(Vertex, clip)},
               {4, GL_FLOAT, GL_FALSE, offsetof(Vertex, cell)},
               {1, GL_FLOAT, GL_FALSE, offsetof(Vertex, fine)},
               {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, fill)},
               {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, line)}},
              sizeof(Vertex)) {}

void Ground::add(const Projection& projection, const Camera& camera, const Plane& plane, const GroundStyle& style) {
  Vec3 across, along;
  span(plane.normal, across, along);
  const Vec3 middle = camera.target - glm::dot(camera.target - plane.point, plane.normal) * plane.normal;

  // Coarse lines are at multiples of ten spacings in world coordinates. Count from the nearest one.
  const double coarse = 10.0 * style.spacing;
  const auto in_plane = [&](const Vec3& place) { return glm::dvec2(glm::dot(place, across), glm::dot(place, along)); };
  const double c = std::cos(style.turn), s = std::sin(style.turn);
  const auto unrotated = [&](const glm::dvec2& offset) { return glm::dvec2(c * offset.x + s * offset.y, c * offset.y - s * offset.x); };
  const glm::dvec2 anchor = in_plane(plane.point);
  const glm::dvec2 place = anchor - in_plane(style.run) + unrotated(in_plane(middle) - anchor);
  const glm::dvec2 cell = (place - coarse * glm::round(place / coarse)) / style.spacing;
  for (const double v : {-1.0, 1.0})
    for (const double u : {-1.0, 1.0}) {
      const glm::vec4 clip(projection.clip(middle + style.reach * (u * across + v * along)));
      const glm::vec2 at(cell + style.reach / style.spacing * unrotated({u, v}));
      vertices_.push_back({{clip.x, clip.y, clip.z, clip.w},
                           {at.x, at.y},
                           {static_cast<float>(u), static_cast<float>(v)},
                           static_cast<float>(style.fine),
                           style.fill,
                           style.line});
    }
}

void Ground::draw(const Shader& shader) {
  shader.use();
  stream_.draw_quads(vertices_.data(), vertices_.size());
}

GroundStyle grid_style_for(const Camera& camera) {
  const double decade = std::log10(0.6 * camera.distance);
  GroundStyle style;
  style.spacing = grid_spacing(camera);
  style.fine = 1.0 - (decade - std::floor(decade));
  style.reach = 5.0 * camera.distance;
  return style;
}

}  // namespace hooke
