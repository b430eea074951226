// Spheres of any size, exact to the pixel: each a quad that covers it, on which the fragment shader casts rays.
#pragma once

#include <vector>

#include "draw/batch.h"
#include "draw/ink.h"
#include "draw/projection.h"

namespace hooke {

class Shader;

class Balls {
 public:
  Balls();
  void clear() { vertices_.clear(); }
  // Nothing when the eye is inside.
  void add(const Projection& projection, const Vec3& center, double radius, Ink ink);
  void draw(const Shader& shader, const Projection& projection);

 private:
  struct Vertex {
    float clip[4];
    float place[3];           // [m], for the viewer
    float center[3], radius;  // [m], for the viewer
    Ink ink;
  };
  std::vector<Vertex> vertices_;
  Stream stream_;
};

}  // namespace hooke
