// Faces as their springs would have them at rest: lengths, angles and areas, which do not depend on the positions.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "sim/model/rest_lengths.h"

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
  int corner = 0;      // opposite
  Index opposite = 0;  // point at that corner
  Index from = 0;      // the end from which the face runs along it
};
// The edges of all faces, those of the same ends next to each other, in the order of the faces.
std::vector<FaceEdge> sorted_edges(const System& system);
// Calls use(edges) for those of the same ends.
template <class Use>
void for_each_edge(const std::vector<FaceEdge>& sorted, const Use& use) {
  for (auto first = sorted.begin(); first != sorted.end();) {
    const auto last = std::find_if(first, sorted.end(), [&](const FaceEdge& edge) { return edge.ends != first->ends; });
    use(std::span(first, last));
    first = last;
  }
}

}  // namespace hooke
