#include "app/collider_drag.h"

namespace hooke {

std::optional<ColliderHit> collider_to_drag(const Workbench& bench, const glm::dvec2& cursor, Takes takes) {
  const std::optional<ColliderHit> hit = bench.collider_at(cursor);
  return hit && (hit->bounded || takes == Takes::All) ? hit : std::nullopt;
}

bool ColliderDrag::begin(const glm::dvec2& cursor, Takes takes, Workbench& bench) {
  *this = {};
  const std::optional<ColliderHit> hit = collider_to_drag(bench, cursor, takes);
  if (!hit) return false;
  collider_ = hit->collider;
  gesture_ = bench.begin_gesture();
  place_ = hit->position;
  target_ = anchor_of(bench.system().colliders[*collider_]);
  grasp_ = target_ - bench.place_beside(cursor, place_);
  return true;
}

void ColliderDrag::follow(const glm::dvec2& cursor, Workbench& bench) {
  const System& system = bench.system();
  if (!collider_ || *collider_ >= static_cast<Index>(system.colliders.size())) return;
  const Vec3 target = bench.place_beside(cursor, place_) + grasp_;
  const bool moved = target != target_;
  target_ = target;
  if (bench.status->running) {
    if (!std::exchange(has_hand_, true))
      bench.lab.submit(GrabCollider{{*collider_, target_}}, gesture_);
    else if (moved)
      bench.lab.submit(MoveHand{target_}, gesture_);
  } else {
    let_go(bench);
    if (!moved) return;
    std::vector<Collider> colliders = system.colliders;
    Collider& mine = colliders[*collider_];
    mine = moved_by(mine, target_ - anchor_of(mine));
    bench.lab.submit(SetColliders{std::move(colliders)}, gesture_);
    has_moved_ = true;
  }
}

void ColliderDrag::let_go(Workbench& bench) {
  if (!std::exchange(has_hand_, false)) return;
  bench.lab.submit(ReleaseHand{}, gesture_);
  has_moved_ = true;
}

void ColliderDrag::end(Workbench& bench) {
  let_go(bench);
  collider_.reset();
}

void ColliderDrag::take_back(Workbench& bench) {
  end(bench);
  if (std::exchange(has_moved_, false)) bench.lab.submit(Undo{});
}

}  // namespace hooke
