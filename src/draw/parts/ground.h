// Flat backgrounds: the grid that everything stands in, planes of spatial scenes as a bounded floor that fades out, and
// planes of flat scenes as a hatched edge.
#pragma once

#include <vector>

#include "draw/colors.h"
#include "draw/gl/vertex_stream.h"
#include "draw/projection.h"

namespace hooke {

class Shader;

// Two unit vectors that span the plane of this normal, along the axes of the world where the plane is.
void span(const Vec3& normal, Vec3& across, Vec3& along);

// Seen from its free side.
bool is_before(const Camera& camera, const Plane& plane);

// How a plane looks.
struct GroundStyle {
  Rgba fill{0, 0, 0, 0};  // of the floor itself
  Rgba line;              // of the grid on it
  double reach = 1.0;     // [m], where it has faded out, from the place under the camera's target
  double spacing = 1.0;   // [m], of the finer grid
  double fine = 1.0;      // opacity of the finer grid against the coarser, ten times as wide
  double turn = 0.0;      // [rad], of the grid about the plane's point and normal
  Vec3 run{0.0};          // [m], of the grid along the plane
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
    float cell[2];  // in spacings of the finer grid, whole at a coarse line
    float fade[2];  // from the middle, 1 at the border
    float fine;
    Rgba fill, line;
  };
  std::vector<Vertex> vertices_;
  VertexStream stream_;
};

// The look of a grid under this camera: spacings are powers of ten, the finer fades as the camera goes away.
GroundStyle grid_style_for(const Camera& camera);

}  // namespace hooke
