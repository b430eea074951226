// The broad phase of contact between points: pairs that are close to each other.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

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
  // Points are sorted into cells that hold nine of ten balls; the larger balls are compared with all points. O(n log n) for balls of
  // similar size. False if there are more than max_pairs.
  bool find(const Plan& plan, const Field& x, std::span<const double> extent, std::vector<PointPair>& pairs, std::size_t max_pairs);

 private:
  struct Cell {
    std::int64_t z = 0, y = 0, x = 0;
    Index point = 0;
    auto operator<=>(const Cell&) const = default;
  };
  void sort_into_cells(const Plan& plan, const Field& x, std::span<const double> extent, double max_extent, double width);

  std::vector<Cell> cells_;
  std::vector<Index> large_;
  std::vector<double> extents_;
};

}  // namespace hooke
