#include "sim/rest_lengths.h"

#include <algorithm>
#include <tuple>

namespace hooke {

std::array<Index, 2> RestLengths::ordered(Index i, Index j) { return {std::min(i, j), std::max(i, j)}; }

RestLengths::RestLengths(const System& system) {
  pairs_.reserve(system.springs().size());
  for (const Spring& spring : system.springs())
    if (spring.rest_length > 0.0)
      pairs_.push_back({ordered(system.index_of(spring.first), system.index_of(spring.second)), spring.rest_length});
  std::ranges::sort(pairs_, {}, [](const Pair& pair) { return std::tuple(pair.ends[0], pair.ends[1], pair.length); });
}

double RestLengths::between(Index i, Index j) const {
  const std::array<Index, 2> ends = ordered(i, j);
  const auto at = std::ranges::lower_bound(pairs_, ends, {}, &Pair::ends);
  return at != pairs_.end() && at->ends == ends ? at->length : 0.0;
}

}  // namespace hooke
