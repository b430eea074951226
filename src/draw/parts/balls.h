// Spheres of any size, exact to the pixel: quads on which the fragment shader casts rays.
#pragma once

#include <vector>

#include "draw/colors.h"
#include "draw/gl/vertex_stream.h"
#include "draw/projection.h"

namespace hooke {

class Shader;

// The marks that show the rotation of a ball: darker and lighter sectors about its axis, one of them starting at the meridian. Unit
// vectors; no axis: no rotation.
struct BallMeridians {
  Vec3 axis{0.0}, meridian{0.0};
};

// The shadow on a ball: its map begins at `corner` [m], in coordinates across and along the pole of the camera, relative to the center of
// the ball.
struct BallShadow {
  float corner[2]{0.0f, 0.0f}, per_meter[2]{0.0f, 0.0f};  // to 0..1 across the map
  float from[2]{0.0f, 0.0f}, size[2]{0.0f, 0.0f};         // of the map in the atlas of all maps; no size: no shadow
};

class Balls {
 public:
  Balls();
  void clear() { vertices_.clear(); }
  // Draws nothing if the eye is inside.
  void add(const Projection& projection, const Vec3& center, double radius, Rgba rgba, const BallMeridians& meridians = {},
           const BallShadow& shade = {});
  // The atlas of all maps must be bound if there are shadows; `pole` is that of the camera.
  void draw(const Shader& shader, const Projection& projection, const Vec3& pole, Rgba shadow);

 private:
  struct Vertex {
    float clip[4];
    float place[3];           // [m], in view coordinates
    float center[3], radius;  // [m], in view coordinates
    Rgba rgba;
    float axis[3], meridian[3];  // in view coordinates
    BallShadow shade;
  };
  std::vector<Vertex> vertices_;
  VertexStream stream_;
};

}  // namespace hooke
