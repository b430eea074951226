#include "draw/ground.h"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "draw/shader.h"

namespace hooke {
namespace {

// Two unit vectors that span the plane, along the axes of the world where the plane is.
void span(const Vec3& normal, Vec3& across, Vec3& along) {
  const Vec3 axis = std::abs(normal.x) < 0.9 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 0.0, 1.0);
  across = glm::normalize(axis - glm::dot(axis, normal) * normal);
  along = glm::cross(normal, across);
}

}  // namespace

Ground::Ground()
    : stream_({{4, GL_FLOAT, GL_FALSE, offsetof(Vertex, clip)},
               {4, GL_FLOAT, GL_FALSE, offsetof(Vertex, cell)},
               {1, GL_FLOAT, GL_FALSE, offsetof(Vertex, fine)},
               {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, fill)},
               {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, line)}},
              sizeof(Vertex)) {}

void Ground::add(const Projection& projection, const Camera& camera, const Plane& plane, const GroundLook& look) {
  Vec3 across, along;
  span(plane.normal, across, along);
  const Vec3 middle = camera.target - glm::dot(camera.target - plane.point, plane.normal) * plane.normal;

  // coarse lines run through multiples of ten spacings of the world's coordinates: count from the nearest one
  const double coarse = 10.0 * look.spacing;
  const glm::dvec2 place(glm::dot(middle, across), glm::dot(middle, along));
  const glm::dvec2 cell = (place - coarse * glm::round(place / coarse)) / look.spacing;
  for (const double v : {-1.0, 1.0})
    for (const double u : {-1.0, 1.0}) {
      const glm::vec4 clip(projection.clip(middle + look.reach * (u * across + v * along)));
      const glm::vec2 at(cell + look.reach / look.spacing * glm::dvec2(u, v));
      vertices_.push_back({{clip.x, clip.y, clip.z, clip.w},
                           {at.x, at.y},
                           {static_cast<float>(u), static_cast<float>(v)},
                           static_cast<float>(look.fine),
                           look.fill,
                           look.line});
    }
}

void Ground::draw(const Shader& shader) {
  shader.use();
  stream_.draw_quads(vertices_.data(), vertices_.size());
}

GroundLook look_from(const Camera& camera) {
  const double decade = std::log10(0.6 * camera.distance);
  const double whole = std::floor(decade);
  GroundLook look;
  look.spacing = std::pow(10.0, whole - 1.0);
  look.fine = 1.0 - (decade - whole);
  look.reach = 5.0 * camera.distance;
  return look;
}

}  // namespace hooke
