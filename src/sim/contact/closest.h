// The closest points of a point and a face, and of two edges.
#pragma once

#include <array>
#include <span>

#include "sim/contact/gap.h"

namespace hooke {

// Of two features with four points together: a point and the three of a face, or two and two of edges.
struct Closest {
  // The closest points are the sums of weight times position over the points of the first, and, with the sign reversed, of the second.
  std::array<double, 4> weight{};
  Vec3 separation{0.0};    // [m], from the second to the first
  double distance = 0.0;   // [m]
  bool is_at_end = false;  // of two edges: whether a closest point is an end
};

enum class FeaturePair : bool { PointFace, TwoEdges };

using FourPoints = std::array<Vec3, 4>;

// A face without area counts as its edges. (C. Ericson, Real-Time Collision Detection, 2005, 5.1.5 and 5.1.9)
Closest closest_points(FeaturePair kind, const FourPoints& x);

// The part of the path x + t displacement, 0 <= t <= 1, on which the distance of both features, `distance` at the start, certainly stays
// above a hundredth of that: additive continuous collision detection (M. Li, D. Kaufman, C. Jiang, Codimensional IPC, 2021, algorithm 1).
// 1: on all of it. Adds the number of distances computed to `steps`: many, if the displacement is far longer than the distance.
double free_part(FeaturePair kind, const FourPoints& x, const FourPoints& displacement, double distance, long& steps);

}  // namespace hooke
