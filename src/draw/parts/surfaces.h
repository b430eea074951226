// Lit triangles: boxes, and filled shapes of 2-D scenes.
#pragma once

#include <vector>

#include "draw/colors.h"
#include "draw/gl/vertex_stream.h"
#include "draw/pixel_box.h"
#include "draw/projection.h"

namespace hooke {

class Shader;

class Surfaces {
 public:
  Surfaces();
  void clear();
  // Adds a corner and returns its index for add_triangle. A zero normal disables lighting.
  GLuint add_corner(const glm::dvec4& clip, const Vec3& view_normal, Rgba rgba);
  void add_triangle(GLuint a, GLuint b, GLuint c);
  // A flat quadrilateral, with its corners in order.
  void add_quad(const Projection& projection, const Vec3 (&corners)[4], const Vec3& normal, Rgba rgba);

  bool is_empty() const { return indices_.empty(); }
  void extend(PixelExtent& extent, const Projection& projection) const;
  void draw(const Shader& shader);

 private:
  struct Vertex {
    float clip[4];
    std::int8_t normal[4];
    Rgba rgba;
  };
  std::vector<Vertex> vertices_;
  std::vector<GLuint> indices_;
  VertexStream stream_;
};

}  // namespace hooke
