#include "sim/model/state.h"

#include <algorithm>

namespace hooke {

void EnergySupply::add_reversible(double work) {
  if (work == 0.0) return;
  net_input += work;
  const double sum = reversible.value_or(0.0) + work, low = min_reversible.value_or(0.0), high = max_reversible.value_or(0.0);
  scale += std::max(0.0, low - sum) + std::max(0.0, sum - high);
  reversible = sum;
  min_reversible = std::min(low, sum);
  max_reversible = std::max(high, sum);
}

Collider carried_collider(const System& system, const State& state, std::size_t collider) {
  Collider result = system.colliders[collider];
  const auto& carried = state.hand.collider;
  if (carried && carried->collider == static_cast<Index>(collider)) result.shape = carried->shape;
  return result;
}

Collider current_collider(const System& system, const State& state, std::size_t collider) {
  return collider_at_time(carried_collider(system, state, collider), state.time);
}

std::vector<Collider> carried_colliders(const System& system, const State& state) {
  std::vector<Collider> colliders;
  for (std::size_t c = 0; c < system.colliders.size(); ++c) colliders.push_back(carried_collider(system, state, c));
  return colliders;
}

}  // namespace hooke
