// Points as impostors: one quad each, on which the fragment shader draws a lit sphere, or a square for a nailed point,
// and a ring around marked points.
#pragma once

#include <vector>

#include "draw/colors.h"
#include "draw/gl/vertex_stream.h"
#include "draw/projection.h"

namespace hooke {

class Shader;

struct PointImpostor {
  float radius = 0.0f;  // [px]
  Rgba body;
  bool square = false;
  float ring = 0.0f;  // [px], outer radius of the ring; 0: none
  Rgba ring_color{0, 0, 0, 0};
};

class PointImpostors {
 public:
  PointImpostors();
  void clear() { vertices_.clear(); }
  void reserve(std::size_t impostors) { vertices_.reserve(4 * impostors); }
  void add(const Projection& projection, const glm::dvec4& clip, const ProjectedPoint& projected, const PointImpostor& impostor);
  // Rings are 1.75 screen pixels wide; a screen pixel is `scale` pixels of the picture.
  void draw(const Shader& shader, int width, int height, double scale);

 private:
  struct Vertex {
    float x, y;            // [px]
    float depth, front;    // at the center and at the closest point to the viewer
    float across, upward;  // [px], from the center
    float radius, ring;    // [px]
    Rgba body, ring_color;
    float square;
  };
  std::vector<Vertex> vertices_;
  VertexStream stream_;
};

}  // namespace hooke
