// Straight lines of a width in pixels: springs, outlines, rubber lines. Soft at both edges without multisampling.
#pragma once

#include <vector>

#include "draw/colors.h"
#include "draw/gl/vertex_stream.h"
#include "draw/projection.h"

namespace hooke {

class Shader;

class Strokes {
 public:
  Strokes();
  void clear() { vertices_.clear(); }
  void reserve(std::size_t strokes) { vertices_.reserve(4 * strokes); }

  // From clip coordinates to clip coordinates, with where they are seen; cut at the borders of the picture. Nothing
  // when an end is no place.
  void add(const Projection& projection, const glm::dvec4& a, const ProjectedPoint& projected_a, const glm::dvec4& b,
           const ProjectedPoint& projected_b, Rgba rgba, float width);
  // The same between places; drawn `lift` pixels nearer than it is, so that it shows on a surface that it lies on.
  void add(const Projection& projection, const Vec3& a, const Vec3& b, Rgba rgba, float width, double depth_offset = 0.0);
  // Dashes and gaps of these lengths [px].
  void add_dashed(const Projection& projection, const Vec3& a, const Vec3& b, Rgba rgba, float width, float dash, float gap);

  void draw(const Shader& shader, int width, int height);

 private:
  struct Vertex {
    float x, y, depth;
    Rgba rgba;
    std::int16_t across, half_width;  // [px / 256]
  };
  void add_projected(float ax, float ay, float a_depth, float bx, float by, float b_depth, Rgba rgba, float width);

  std::vector<Vertex> vertices_;
  VertexStream stream_;
};

}  // namespace hooke
