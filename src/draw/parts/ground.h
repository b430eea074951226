// Flat backgrounds: the grid, planes of 3-D scenes as a bounded floor that fades out, and planes of 2-D scenes as a hatched edge.
#pragma once

#include <vector>

#include "draw/colors.h"
#include "draw/gl/vertex_stream.h"
#include "draw/projection.h"

namespace hooke {

class Shader;

// Two unit vectors that span the plane of this normal, along the coordinate axes if the plane is parallel to them.
void span(const Vec3& normal, Vec3& across, Vec3& along);

// Whether the camera is on the free side of the plane.
bool is_before(const Camera& camera, const Plane& plane);

// The appearance of a plane.
struct GroundStyle {
  Rgba fill{0, 0, 0, 0};  // of the floor
  Rgba line;              // of the grid on the floor
  double reach = 1.0;     // [m], distance at which it has faded out, from the position below the target of the camera
  double spacing = 1.0;   // [m], of the finer grid
  double fine = 1.0;      // opacity of the finer grid relative to the coarser one, whose spacing is ten times as large
  double turn = 0.0;      // [rad], rotation of the grid about the point and normal of the plane
  Vec3 run{0.0};          // [m], translation of the grid along the plane
};

class Ground {
 public:
  Ground();
  void clear() { vertices_.clear(); }
  void add(const Projection& projection, const Camera& camera, const Plane& plane, const GroundStyle& style);
  bool is_empty() const { return vertices_.empty(); }
  void draw(const Shader& shader);

 private:
  struct Vertex {
    float clip[4];
    float cell[2];  // in spacings of the finer grid, an integer at a coarse line
    float fade[2];  // relative to the center, 1 at the border
    float fine;
    Rgba fill, line;
  };
  std::vector<Vertex> vertices_;
  VertexStream stream_;
};

// The style of a grid for this camera: spacings are powers of ten, and the finer grid fades as the camera moves away.
GroundStyle grid_style_for(const Camera& camera);

}  // namespace hooke
