// Straight lines with a width in pixels: springs, outlines, previews. Antialiased without multisampling.
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

  // Between two clip coordinates and their projections, clipped to the picture. Draws nothing if an end is not finite.
  void add(const Projection& projection, const glm::dvec4& a, const ProjectedPoint& projected_a, const glm::dvec4& b,
           const ProjectedPoint& projected_b, Rgba rgba, float width);
  // The same between two positions, drawn `depth_offset` [m] closer to the viewer, so that it is visible on a surface.
  void add(const Projection& projection, const Vec3& a, const Vec3& b, Rgba rgba, float width, double depth_offset = 0.0);
  // A dashed line; lengths of dashes and gaps in [px].
  void add_dashed(const Projection& projection, const Vec3& a, const Vec3& b, Rgba rgba, float width, float dash, float gap);

  // A line with a head of two lines of this length [px] at its end, or of a part of the line where that is shorter.
  void add_arrow(const Projection& projection, const Vec3& a, const Vec3& b, Rgba rgba, float width, float head);

  void draw(const Shader& shader, int width, int height);

 private:
  struct Vertex {
    float x, y, depth;
    Rgba rgba;
    std::int16_t across, half_width;  // [px / 256]
  };
  void add_projected(const ProjectedPoint& a, const ProjectedPoint& b, Rgba rgba, float width);

  std::vector<Vertex> vertices_;
  VertexStream stream_;
};

}  // namespace hooke
