#include "sim/plan/pair_plan.h"

#include <algorithm>

namespace hooke {

bool PairPlan::excludes(Index i, Index j) const { return std::ranges::binary_search(joined, std::array{i, j}); }

PairPlan plan_pairs(const System& system) {
  const PairContact& contact = system.contact;
  if (!contact.points) return {};
  PairPlan plan{.on = true, .thickness = contact.thickness, .restitution = contact.restitution, .friction = contact.friction, .joined = {}};
  for (const Spring& spring : system.springs()) {
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    const double touching = system.points()[i].radius + system.points()[j].radius + contact.thickness;
    // placed at the distance at which they touch, up to rounding, is touching
    if (spring.rest_length <= touching * (1.0 + 1e-9)) plan.joined.push_back({std::min(i, j), std::max(i, j)});
  }
  std::ranges::sort(plan.joined);
  return plan;
}

}  // namespace hooke
