#include "draw/parts/surfaces.h"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "draw/gl/shader.h"

namespace hooke {

Surfaces::Surfaces()
    : stream_({{4, GL_FLOAT, GL_FALSE, offsetof(Vertex, clip)},
               {4, GL_BYTE, GL_TRUE, offsetof(Vertex, normal)},
               {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, rgba)}},
              sizeof(Vertex)) {}

void Surfaces::clear() {
  vertices_.clear();
  indices_.clear();
}

GLuint Surfaces::add_corner(const glm::dvec4& clip, const Vec3& view_normal, Rgba rgba) {
  const double length = glm::length(view_normal);
  const Vec3 unit = length > 0.0 && std::isfinite(length) ? view_normal / length : Vec3(0.0);
  const auto byte = [](double component) { return static_cast<std::int8_t>(std::lround(127.0 * component)); };
  vertices_.push_back({{static_cast<float>(clip.x), static_cast<float>(clip.y), static_cast<float>(clip.z), static_cast<float>(clip.w)},
                       {byte(unit.x), byte(unit.y), byte(unit.z), 0},
                       rgba});
  return static_cast<GLuint>(vertices_.size() - 1);
}

void Surfaces::add_triangle(GLuint a, GLuint b, GLuint c) { indices_.insert(indices_.end(), {a, b, c}); }

void Surfaces::add_quad(const Projection& projection, const Vec3 (&corners)[4], const Vec3& normal, Rgba rgba) {
  const Vec3 view_normal = projection.view_direction(normal);
  const auto first = static_cast<GLuint>(vertices_.size());
  for (const Vec3& corner : corners) add_corner(projection.clip(corner), view_normal, rgba);
  add_triangle(first, first + 1, first + 2);
  add_triangle(first, first + 2, first + 3);
}

void Surfaces::extend(PixelExtent& extent, const Projection& projection) const {
  for (const Vertex& corner : vertices_) extent.add(projection.project({corner.clip[0], corner.clip[1], corner.clip[2], corner.clip[3]}));
}

void Surfaces::draw(const Shader& shader) {
  shader.use();
  stream_.draw_indexed(vertices_.data(), vertices_.size(), indices_);
}

}  // namespace hooke
