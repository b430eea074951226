#include "sim/plan/numbering/cuthill_mckee.h"

#include <algorithm>
#include <tuple>

namespace hooke {

void append_near_neighbors(const SpringGraph& graph, std::vector<char>& done, std::vector<Index>& order) {
  std::vector<Index> seen(static_cast<std::size_t>(graph.points()), no_index);
  std::vector<Index> part;
  // The last point of a search that begins here; of those as far away, the one with the fewest springs. `search` tells searches apart.
  const auto find_far = [&](Index start, Index search) {
    part.assign(1, start);
    seen[start] = search;
    std::size_t level = 0;
    for (std::size_t at = 0, end = 1; at < part.size(); ++at) {
      if (at == end) {
        level = at;
        end = part.size();
      }
      for (const Index j : graph.neighbors(part[at])) {
        if (done[j] || seen[j] == search) continue;
        seen[j] = search;
        part.push_back(j);
      }
    }
    return *std::min_element(part.begin() + static_cast<std::ptrdiff_t>(level), part.end(),
                             [&](Index i, Index j) { return std::tuple(graph.degree(i), i) < std::tuple(graph.degree(j), j); });
  };

  for (Index i = 0; i < graph.points(); ++i) {
    if (done[i]) continue;
    // no two parts have points in common, so that two numbers are enough
    const Index start = find_far(find_far(i, 0), 1);
    const std::size_t first = order.size();
    order.push_back(start);
    done[start] = 1;
    for (std::size_t at = first; at < order.size(); ++at) {
      const std::size_t begin = order.size();
      for (const Index j : graph.neighbors(order[at])) {
        if (done[j]) continue;
        done[j] = 1;
        order.push_back(j);
      }
      std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin), order.end(),
                [&](Index a, Index b) { return std::tuple(graph.degree(a), a) < std::tuple(graph.degree(b), b); });
    }
    std::reverse(order.begin() + static_cast<std::ptrdiff_t>(first), order.end());
  }
}

}  // namespace hooke
