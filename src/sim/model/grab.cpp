#include "sim/model/grab.h"

#include <glm/geometric.hpp>

#include "sim/model/portable_math.h"

namespace hooke {

// x = c + (n . d) n + cos(a) p + sin(a) n x d,  d = from - c,  p = d - (n . d) n,  a = speed (t - begin) / |p|
Vec3 position_at(const ScriptedHand& hand, double time) {
  const Vec3 &n = hand.axis, d = hand.from - hand.center;
  const Vec3 along = glm::dot(n, d) * n, p = d - along;
  const double angle = hand.speed * (time - hand.begin) / glm::length(p);
  return hand.center + along + portable::cos(angle) * p + portable::sin(angle) * glm::cross(n, d);
}

std::optional<ActiveGrab> active_grab(const System& system, const State& state, double duration) {
  if (system.grab) return ActiveGrab{system.grab->point, system.grab->kind, state.hand.target};
  if (!system.scripted_hand) return std::nullopt;
  const ScriptedHand& hand = *system.scripted_hand;
  if (system.index_of(hand.point) == no_index) return std::nullopt;

  // frames begin at integer multiples of their duration, up to round-off
  const double since = state.time - hand.begin, round_off = 1e-6 * duration;
  if (since < -round_off || since > hand.seconds - round_off) return std::nullopt;
  return ActiveGrab{hand.point, GrabKind::Hold, position_at(hand, state.time + duration)};
}

}  // namespace hooke
