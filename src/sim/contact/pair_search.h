// The broad phase of contact between points: pairs that are close to each other.
#pragma once

#include <compare>
#include <span>
#include <vector>

#include "sim/contact/box_tree.h"
#include "sim/plan/plan.h"

namespace hooke {

// Two points, i < j.
struct PointPair {
  Index i = 0, j = 0;
  auto operator<=>(const PointPair&) const = default;
};

class PairSearch {
 public:
  // Pairs whose balls of radius `extent` [m] about x overlap, in ascending order; without those that are excluded or that cannot move.
  // O(n log n) for balls of similar size. False if there are more than max_pairs.
  bool find(const Plan& plan, const Field& x, std::span<const double> extent, std::vector<PointPair>& pairs, std::size_t max_pairs);

 private:
  BoxTree tree_;
  std::vector<Vec3> places_;
};

}  // namespace hooke
