#include "sim/model/rest_lengths.h"

#include <algorithm>
#include <tuple>

namespace hooke {

RestLengths::RestLengths(const System& system) {
  pairs_.reserve(system.springs().size());
  for (const Spring& spring : system.springs())
    if (spring.rest_length > 0.0)
      pairs_.push_back({edge_ends(system.index_of(spring.first), system.index_of(spring.second)), spring.rest_length});
  std::ranges::sort(pairs_, {}, [](const Pair& pair) { return std::tuple(pair.ends, pair.length); });
}

double RestLengths::between(Index i, Index j) const {
  const EdgeEnds ends = edge_ends(i, j);
  const auto at = std::ranges::lower_bound(pairs_, ends, {}, &Pair::ends);
  return at != pairs_.end() && at->ends == ends ? at->length : 0.0;
}

}  // namespace hooke
