#include "sim/hand.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace hooke {

// x = c + (n . d) n + cos(a) p + sin(a) n x d,  d = from - c,  p = d - (n . d) n,  a = speed (t - begin) / |p|
Vec3 place_at(const ScriptedHand& hand, double time) {
  const Vec3 &n = hand.axis, d = hand.from - hand.center;
  const Vec3 along = glm::dot(n, d) * n, p = d - along;
  const double angle = hand.speed * (time - hand.begin) / glm::length(p);
  return hand.center + along + std::cos(angle) * p + std::sin(angle) * glm::cross(n, d);
}

std::optional<Grab> acting_grab(const System& system, double time, double duration) {
  if (system.grab || !system.scripted_hand) return system.grab;
  const ScriptedHand& hand = *system.scripted_hand;
  if (system.index_of(hand.point) == no_index) return std::nullopt;

  // frames begin at whole multiples of their duration, but for round-off
  const double since = time - hand.begin, round_off = 1e-6 * duration;
  if (since < -round_off || since > hand.seconds - round_off) return std::nullopt;
  return Grab{.point = hand.point, .kind = GrabKind::Hold, .target = place_at(hand, time + duration)};
}

}  // namespace hooke
