#include "sim/state.h"

namespace hooke {

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
