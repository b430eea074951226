// Disjoint sets of items 0, 1, ..., joined two at a time (union-find).
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "base/types.h"

namespace hooke {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count = 0) { reset(count); }
  // All items apart. Allocates only if there were never as many.
  void reset(std::size_t count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  // The smallest item of the set of item i.
  Index root(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Index i, Index j) {
    const Index a = root(i), b = root(j);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace hooke
