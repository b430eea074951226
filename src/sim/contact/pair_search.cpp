#include "sim/contact/pair_search.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace hooke {

bool PairSearch::find(const Plan& plan, const Field& x, std::span<const double> extent, std::vector<PointPair>& pairs,
                      std::size_t max_pairs) {
  pairs.clear();
  if (plan.points < 2) return true;
  places_.clear();
  for (Index i = 0; i < plan.points; ++i) places_.push_back(vector_at(plan, x, i));
  tree_.build(places_);
  const std::span<const Index> order = tree_.order();
  const auto box_of = [&](Index i) { return SurfaceBox{places_[i] - extent[i], places_[i] + extent[i]}; };
  tree_.fit([&](const BoxRange& items) {
    SurfaceBox box = box_of(order[items.begin]);
    for (Index k = items.begin; k < items.end; ++k) box.include(box_of(order[k]));
    return box;
  });

  const std::vector<double>& inverse_mass = plan.inverse_mass_in_contact();
  const auto add = [&](Index a, Index b) {
    const Vec3 d = places_[a] - places_[b];
    const double reach = extent[a] + extent[b];
    if (glm::dot(d, d) > reach * reach || (inverse_mass[a] == 0.0 && inverse_mass[b] == 0.0)) return;
    const PointPair pair{std::min(a, b), std::max(a, b)};
    if (!plan.pairs.excludes(pair.i, pair.j)) pairs.push_back(pair);
  };
  tree_.visit_close(0.0, [&](const BoxTree::Node& first, const BoxTree::Node& second) {
    for (Index a = first.items.begin; a < first.items.end; ++a)
      for (Index b = &first == &second ? a + 1 : second.items.begin; b < second.items.end; ++b) add(order[a], order[b]);
    return pairs.size() <= max_pairs;
  });
  const bool is_complete = pairs.size() <= max_pairs;
  if (!is_complete) pairs.resize(max_pairs);
  std::ranges::sort(pairs);
  return is_complete;
}

}  // namespace hooke
