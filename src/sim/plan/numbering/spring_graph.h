// The graph of springs, as lists of neighbors.
#pragma once

#include <span>
#include <vector>

#include "sim/model/rest_lengths.h"

namespace hooke {

// Springs between the same points count once, those from a point to itself not at all.
class SpringGraph {
 public:
  SpringGraph(Index points, std::span<const EdgeEnds> edges);
  Index points() const { return static_cast<Index>(begin_.size()) - 1; }
  // In ascending order.
  std::span<const Index> neighbors(Index i) const {
    return {neighbors_.data() + begin_[i], static_cast<std::size_t>(begin_[i + 1] - begin_[i])};
  }
  Index degree(Index i) const { return begin_[i + 1] - begin_[i]; }
  bool joins(Index i, Index j) const;

 private:
  std::vector<Index> begin_, neighbors_;
};

}  // namespace hooke
