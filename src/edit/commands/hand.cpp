#include <algorithm>
#include <cmath>

#include "base/finite.h"
#include "edit/command.h"
#include "edit/commands/validity.h"
#include "edit/in_plane.h"

namespace hooke {
namespace {

bool is_valid(const GrabPoint::Item& grab) {
  if (!is_finite(grab.target) || !(grab.stiffness >= 0.0) || !std::isfinite(grab.stiffness)) return false;
  if (!grab.patch) return true;
  const auto& [a, b, c] = grab.patch->points;
  const auto& weights = grab.patch->weights;
  const bool is_between = a != b && b != c && c != a && (grab.point == a || grab.point == b || grab.point == c);
  const bool are_weights = std::all_of(weights.begin(), weights.end(), [](double weight) { return weight >= 0.0; }) &&
                           std::abs(weights[0] + weights[1] + weights[2] - 1.0) < 1e-9;
  return is_between && are_weights && grab.kind == GrabKind::Pull;
}

// Leaves the carried collider where the hand has moved it.
void release_collider(Scene& scene, Effect& effect) {
  auto& carried = scene.state.hand.collider;
  if (!carried) return;
  Collider moved = scene.system.colliders[static_cast<std::size_t>(carried->collider)];
  moved.shape = carried->shape;
  // a hand far out of range may have moved it to a position that is not finite
  if (is_valid(moved)) scene.system.colliders[static_cast<std::size_t>(carried->collider)] = moved;
  carried.reset();
  effect.values = true;
}

}  // namespace

std::vector<PointId> points_of(const Grab& grab) {
  if (!grab.patch) return {grab.point};
  return {grab.patch->points.begin(), grab.patch->points.end()};
}

Inverse GrabPoint::apply(Scene& scene, Effect& effect) const {
  if (!is_valid(grab)) return {};
  const Grab held{grab.point, grab.patch, grab.kind, grab.stiffness};
  Move back;
  for (const PointId id : points_of(held)) {
    const Index i = scene.system.index_of(id);
    if (i == no_index) return {};
    back.items.push_back({id, scene.state.position[i], scene.state.velocity[i]});
  }
  scene.system.grab = held;
  Hand& hand = scene.state.hand;
  hand.target = in_plane(scene.system, grab.target);
  hand.position = grab.kind == GrabKind::Hold ? back.items[0].position : hand.target;
  effect.values = true;
  return {ReleaseHand{}, back};
}

Inverse GrabCollider::apply(Scene& scene, Effect& effect) const {
  const Index c = grab.collider;
  if (c < 0 || c >= static_cast<Index>(scene.system.colliders.size()) || !is_finite(grab.target)) return {};
  if (scene.system.colliders[static_cast<std::size_t>(c)].one_way) return {};
  release_collider(scene, effect);
  scene.state.hand.collider = {c, scene.system.colliders[static_cast<std::size_t>(c)].shape, grab.target};
  return {ReleaseHand{}, SetColliders{scene.system.colliders}};
}

Inverse MoveHand::apply(Scene& scene, Effect&) const {
  if (!is_finite(target)) return {};
  Hand& hand = scene.state.hand;
  if (hand.collider) hand.collider->target = target;
  if (scene.system.grab) hand.target = in_plane(scene.system, target);
  return {};
}

Inverse ReleaseHand::apply(Scene& scene, Effect& effect) const {
  release_collider(scene, effect);
  if (!scene.system.grab) return {};
  const Index i = scene.system.index_of(scene.system.grab->point);
  // a nailed point stops where it is released
  Inverse inverse;
  if (scene.system.points()[i].nailed && scene.state.velocity[i] != Vec3(0.0)) {
    inverse = {Move{{{scene.system.grab->point, scene.state.position[i], scene.state.velocity[i]}}}};
    scene.state.velocity[i] = Vec3(0.0);
  }
  scene.system.grab.reset();
  effect.values = true;
  return inverse;
}

}  // namespace hooke
