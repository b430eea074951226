// The faces of a scene as one smooth, lit surface.
#pragma once

#include "draw/net.h"
#include "draw/surfaces.h"

namespace hooke {

class ClothMesh {
 public:
  // Faces with a corner that is no place are left out.
  void add(const Subject& subject, const Net& net, Surfaces& surfaces);

 private:
  std::vector<Vec3> normals_;   // a point, each face's share by its area
  std::vector<Index> corners_;  // three a face that can be drawn
};

}  // namespace hooke
