#include "draw/parts/balls.h"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "draw/gl/shader.h"
#include "draw/parts/ground.h"

namespace hooke {

Balls::Balls()
    : stream_({{4, GL_FLOAT, GL_FALSE, offsetof(Vertex, clip)},
               {3, GL_FLOAT, GL_FALSE, offsetof(Vertex, place)},
               {4, GL_FLOAT, GL_FALSE, offsetof(Vertex, center)},
               {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, rgba)},
               {3, GL_FLOAT, GL_FALSE, offsetof(Vertex, axis)},
               {3, GL_FLOAT, GL_FALSE, offsetof(Vertex, meridian)},
               {4, GL_FLOAT, GL_FALSE, offsetof(Vertex, shade.corner)},
               {4, GL_FLOAT, GL_FALSE, offsetof(Vertex, shade.from)}},
              sizeof(Vertex)) {}

void Balls::add(const Projection& projection, const Vec3& center, double radius, Rgba rgba, const BallMeridians& meridians,
                const BallShadow& shade) {
  const Vec3 c = projection.view_position(center);
  const double distance = glm::length(c);
  const bool is_flat = projection.is_orthographic();
  if (!std::isfinite(distance) || (!is_flat && distance <= 1.001 * radius)) return;

  // Perpendicular to the line of sight. In perspective, the cone tangent to the sphere is wider than the sphere at its center.
  const Vec3 towards = is_flat ? Vec3(0.0, 0.0, 1.0) : -c / distance;
  const double cone = is_flat ? radius : radius * distance / std::sqrt(distance * distance - radius * radius);
  const double reach = 1.02 * cone + 2.0 / projection.scale(projection.clip(center));
  const Vec3 right = glm::normalize(glm::cross(std::abs(towards.y) < 0.9 ? Vec3(0.0, 1.0, 0.0) : Vec3(1.0, 0.0, 0.0), towards));
  const Vec3 up = glm::cross(towards, right);
  const glm::vec3 axis(projection.view_direction(meridians.axis)), meridian(projection.view_direction(meridians.meridian));
  for (const double y : {-reach, reach})
    for (const double x : {-reach, reach}) {
      const glm::vec3 p(c + x * right + y * up);
      const glm::vec4 clip(projection.clip_from_view(Vec3(p)));
      vertices_.push_back({{clip.x, clip.y, clip.z, clip.w},
                           {p.x, p.y, p.z},
                           {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)},
                           static_cast<float>(radius),
                           rgba,
                           {axis.x, axis.y, axis.z},
                           {meridian.x, meridian.y, meridian.z},
                           shade});
    }
}

void Balls::draw(const Shader& shader, const Projection& projection, const Vec3& pole, Rgba shadow) {
  if (vertices_.empty()) return;
  shader.use();
  Vec3 across, along;
  span(pole, across, along);
  const glm::mat3 from_above(projection.view_direction(across), projection.view_direction(along), projection.view_direction(pole));
  glUniformMatrix3fv(shader.uniform("from_above"), 1, GL_FALSE, &from_above[0][0]);
  glUniform4f(shader.uniform("shadow"), shadow.red / 255.0f, shadow.green / 255.0f, shadow.blue / 255.0f, shadow.opacity / 255.0f);
  glUniform1i(shader.uniform("maps"), 0);
  const glm::dmat4& matrix = projection.matrix();
  glUniform2f(shader.uniform("depth"), static_cast<float>(matrix[2][2]), static_cast<float>(matrix[3][2]));
  glUniform1i(shader.uniform("orthographic"), projection.is_orthographic() ? 1 : 0);
  stream_.draw_quads(vertices_.data(), vertices_.size());
}

}  // namespace hooke
