// Spheres of any size, exact to the pixel: each a quad that covers it, on which the fragment shader casts rays.
#pragma once

#include <vector>

#include "draw/colors.h"
#include "draw/gl/vertex_stream.h"
#include "draw/projection.h"

namespace hooke {

class Shader;

// What shows how a ball turns: darker and lighter sectors about its axis, one of them beginning at the meridian. Unit
// vectors; no axis: it does not turn.
struct BallMeridians {
  Vec3 axis{0.0}, meridian{0.0};
};

// The shade on a ball: its map begins at `corner` [m], in coordinates across and along the camera's pole from the middle of
// the ball.
struct BallShadow {
  float corner[2]{0.0f, 0.0f}, per_metre[2]{0.0f, 0.0f};  // to 0..1 across the map
  float from[2]{0.0f, 0.0f}, size[2]{0.0f, 0.0f};         // of the map in the picture of all maps; no size: no shade
};

class Balls {
 public:
  Balls();
  void clear() { vertices_.clear(); }
  // Nothing when the eye is inside.
  void add(const Projection& projection, const Vec3& center, double radius, Rgba rgba, const BallMeridians& meridians = {},
           const BallShadow& shade = {});
  // The picture of all maps of shade must be bound where there is any; `pole` is the camera's.
  void draw(const Shader& shader, const Projection& projection, const Vec3& pole, Rgba shadow);

 private:
  struct Vertex {
    float clip[4];
    float place[3];           // [m], for the viewer
    float center[3], radius;  // [m], for the viewer
    Rgba rgba;
    float axis[3], meridian[3];  // for the viewer
    BallShadow shade;
  };
  std::vector<Vertex> vertices_;
  VertexStream stream_;
};

}  // namespace hooke
