// Faces as their springs would have them at rest: lengths, angles and areas, which do not depend on the positions.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/model/rest_lengths.h"

namespace hooke {

using FaceCorners = std::array<Index, 3>;

// A face at rest. Side i is opposite corner i.
struct RestFace {
  FaceCorners corners{};
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
// All edges of faces with these corners, those of the same ends next to each other.
std::vector<FaceEdge> sorted_edges(std::span<const FaceCorners> faces);
std::vector<FaceCorners> corners_of(const std::vector<RestFace>& faces);

}  // namespace hooke
