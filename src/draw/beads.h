// Points as impostors: a quad each, on which the fragment shader draws a lit sphere, or a square for a nailed point,
// with a ring around it when it is marked.
#pragma once

#include <vector>

#include "draw/batch.h"
#include "draw/ink.h"
#include "draw/projection.h"

namespace hooke {

class Shader;

struct Bead {
  float radius = 0.0f;  // [px]
  Ink body;
  bool square = false;
  float ring = 0.0f;  // [px], outer radius of the ring; 0: none
  Ink ring_ink{0, 0, 0, 0};
};

class Beads {
 public:
  Beads();
  void clear() { vertices_.clear(); }
  void reserve(std::size_t beads) { vertices_.reserve(4 * beads); }
  void add(const Projection& projection, const glm::dvec4& clip, const Seen& seen, const Bead& bead);
  // Rings are 1.75 of the screen's pixels wide, a pixel of the screen being `scale` of the picture's.
  void draw(const Shader& shader, int width, int height, double scale);

 private:
  struct Vertex {
    float x, y;            // [px]
    float depth, front;    // of the center and of the place nearest to the viewer
    float across, upward;  // [px], from the center
    float radius, ring;    // [px]
    Ink body, ring_ink;
    float square;
  };
  std::vector<Vertex> vertices_;
  Stream stream_;
};

}  // namespace hooke
