// The closest points of many pairs of features at once, by vectors.
#pragma once

#include <array>
#include <span>

#include "sim/contact/closest.h"

namespace hooke {

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

// The distances of all of these pairs alone [m].
void find_distances(FeaturePair kind, std::span<const Vec3> x, std::span<const std::array<Index, 4>> pairs, std::span<double> distances);

}  // namespace hooke
