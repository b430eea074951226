#include "sim/plan/spring_runs.h"

#include <algorithm>
#include <utility>

#include "sim/plan/constants.h"

namespace hooke {
namespace {

struct Ends {
  Index first, second, spring;
};

// By a key from 0 to limit - 1; those of the same key stay in their order.
template <class Key>
void sort_by(std::vector<Ends>& ends, Index limit, const Key& key) {
  std::vector<std::size_t> next(static_cast<std::size_t>(limit) + 1, 0);
  for (const Ends& each : ends) ++next[static_cast<std::size_t>(key(each)) + 1];
  for (std::size_t k = 1; k < next.size(); ++k) next[k] += next[k - 1];
  std::vector<Ends> sorted(ends.size());
  for (const Ends& each : ends) sorted[next[static_cast<std::size_t>(key(each))]++] = each;
  ends = std::move(sorted);
}

}  // namespace

void find_runs(const System& system, std::vector<SpringRun>& runs, std::vector<Index>& spring_index) {
  std::vector<Ends> ends;
  ends.reserve(system.springs().size());
  Index points = 0;
  for (const Spring& spring : system.springs()) {
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    ends.push_back({std::min(i, j), std::max(i, j), static_cast<Index>(ends.size())});
    points = std::max(points, ends.back().second + 1);
  }

  // sorted by offset, then index, springs form runs; sorted by the index of their first spring, the runs are in the order of the points, so
  // that neighboring runs find their points in the cache
  sort_by(ends, points, [](const Ends& each) { return each.first; });
  sort_by(ends, points, [](const Ends& each) { return each.second - each.first; });
  struct Found {
    std::size_t begin;
    Index count;
  };
  std::vector<Found> found;
  for (std::size_t e = 0; e < ends.size(); ++e) {
    // split into some hundred springs, so that runs along the whole scene do not evict the cache for each direction
    const bool continues = !found.empty() && found.back().count < max_run_length && ends[e].first == ends[e - 1].first + 1 &&
                           ends[e].second == ends[e - 1].second + 1;
    if (continues)
      ++found.back().count;
    else
      found.push_back({e, 1});
  }
  std::stable_sort(found.begin(), found.end(), [&](const Found& a, const Found& b) { return ends[a.begin].first < ends[b.begin].first; });

  runs.clear();
  spring_index.clear();
  spring_index.reserve(ends.size());
  for (const Found& run : found) {
    runs.push_back({static_cast<Index>(spring_index.size()), ends[run.begin].first, ends[run.begin].second, run.count});
    for (Index e = 0; e < run.count; ++e) spring_index.push_back(ends[run.begin + e].spring);
  }
}

}  // namespace hooke
