// The closest points of a point and a face, and of two edges, by vectors of many such pairs.
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

// Pairs of one kind, each of four points. Nothing else is initialized.
struct FeatureBlock {
  static constexpr int capacity = 64;
  std::array<std::array<Index, 4>, capacity> points;
  int count = 0;

  // Results, in the order of `points`: the parts of Closest.
  alignas(64) double weight[4][capacity];
  alignas(64) double separation[3][capacity];  // [m]
  alignas(64) double distance[capacity];       // [m]
  alignas(64) double is_at_end[capacity];      // 1 or 0

  Closest closest(int pair) const {
    return {.weight = {weight[0][pair], weight[1][pair], weight[2][pair], weight[3][pair]},
            .separation = {separation[0][pair], separation[1][pair], separation[2][pair]},
            .distance = distance[pair],
            .is_at_end = is_at_end[pair] != 0.0};
  }
};

// The results: those of closest_points, on every vector unit.
void find_closest(FeaturePair kind, std::span<const Vec3> x, FeatureBlock& block);

}  // namespace hooke
