#include "sim/plan/numbering/spring_graph.h"

#include <algorithm>

namespace hooke {

SpringGraph::SpringGraph(Index points, std::span<const EdgeEnds> edges) : begin_(static_cast<std::size_t>(points) + 1, 0) {
  for (const auto& [i, j] : edges)
    if (i != j) ++begin_[i + 1], ++begin_[j + 1];
  for (Index i = 0; i < points; ++i) begin_[i + 1] += begin_[i];
  neighbors_.resize(static_cast<std::size_t>(begin_.back()));
  std::vector<Index> next(begin_.begin(), begin_.end() - 1);
  for (const auto& [i, j] : edges) {
    if (i == j) continue;
    neighbors_[next[i]++] = j;
    neighbors_[next[j]++] = i;
  }
  Index end = 0;
  for (Index i = 0; i < points; ++i) {
    const auto first = neighbors_.begin() + begin_[i], last = neighbors_.begin() + begin_[i + 1];
    std::sort(first, last);
    const auto unique_end = std::unique(first, last);
    begin_[i] = end;
    end = static_cast<Index>(std::copy(first, unique_end, neighbors_.begin() + end) - neighbors_.begin());
  }
  begin_[points] = end;
  neighbors_.resize(static_cast<std::size_t>(end));
}

bool SpringGraph::joins(Index i, Index j) const { return std::ranges::binary_search(neighbors(i), j); }

}  // namespace hooke
