// Faces as their springs would have them at rest: lengths, angles and areas, which do not depend on the positions.
#pragma once

#include <array>
#include <vector>

#include "sim/rest_lengths.h"

namespace hooke {

// A face at rest. Side i is opposite corner i.
struct RestFace {
  std::array<Index, 3> corners{};
  std::array<double, 3> length{}, cotangent{};  // of the sides [m], of the angles at the corners
  double area = 0.0;                            // [m^2]; 0: unknown
};

// Where one edge has no spring, its angle is taken as right: it is a diagonal. The area is unknown if more edges have none, or if the face
// is degenerate.
RestFace rest_face(const System& system, const RestLengths& lengths, const Face& face);

// An edge of a face.
struct FaceEdge {
  EdgeEnds ends;
  Index face = 0;
  int corner = 0;  // opposite
};
// All edges of the faces, those of the same ends next to each other.
std::vector<FaceEdge> sorted_edges(const std::vector<RestFace>& faces);

}  // namespace hooke
