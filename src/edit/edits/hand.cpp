#include <algorithm>

#include "edit/edits/edits.h"

namespace hooke {
namespace {

bool is_valid(const Grab& grab) {
  if (!is_finite(grab.target) || !(grab.stiffness >= 0.0) || !std::isfinite(grab.stiffness)) return false;
  if (!grab.patch) return true;
  const auto& [a, b, c] = grab.patch->points;
  const auto& shares = grab.patch->shares;
  const bool is_between = a != b && b != c && c != a && (grab.point == a || grab.point == b || grab.point == c);
  const bool is_whole = std::all_of(shares.begin(), shares.end(), [](double share) { return share >= 0.0; }) &&
                        std::abs(shares[0] + shares[1] + shares[2] - 1.0) < 1e-9;
  return is_between && is_whole && grab.kind == GrabKind::Pull;
}

}  // namespace

std::vector<PointId> points_of(const Grab& grab) {
  if (!grab.patch) return {grab.point};
  return {grab.patch->points.begin(), grab.patch->points.end()};
}

Inverse Apply::operator()(const GrabPoint& grab) {
  if (!is_valid(grab.grab)) return {};
  Move back;
  for (const PointId id : points_of(grab.grab)) {
    const Index i = scene.system.index_of(id);
    if (i == no_index) return {};
    back.items.push_back({id, scene.state.position[i], scene.state.velocity[i]});
  }
  scene.system.grab = grab.grab;
  scene.system.grab->target = in_plane(scene.system, grab.grab.target);
  scene.state.hand = grab.grab.kind == GrabKind::Hold ? back.items[0].position : scene.system.grab->target;
  effect.values = true;
  return {ReleaseHand{}, back};
}

Inverse Apply::operator()(const GrabCollider& grab) {
  const Index c = grab.grab.collider;
  if (c < 0 || c >= static_cast<Index>(scene.system.colliders.size()) || !is_finite(grab.grab.target)) return {};
  scene.system.collider_grab = grab.grab;
  effect.values = true;
  return {ReleaseHand{}, SetColliders{scene.system.colliders}};
}

Inverse Apply::operator()(const MoveHand& move) {
  if (scene.system.collider_grab && is_finite(move.target)) scene.system.collider_grab->target = move.target;
  if (scene.system.grab && is_finite(move.target)) scene.system.grab->target = in_plane(scene.system, move.target);
  return {};
}

Inverse Apply::operator()(const ReleaseHand&) {
  effect.values = effect.values || scene.system.collider_grab;
  scene.system.collider_grab.reset();
  if (!scene.system.grab) return {};
  const Index i = scene.system.index_of(scene.system.grab->point);
  if (scene.system.points()[i].nailed) scene.state.velocity[i] = Vec3(0.0);
  scene.system.grab.reset();
  effect.values = true;
  return {};
}

}  // namespace hooke
