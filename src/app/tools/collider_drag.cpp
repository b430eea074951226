#include "app/tools/collider_drag.h"

namespace hooke {

std::optional<ColliderHit> collider_to_drag(const ToolContext& context, const glm::dvec2& cursor, DraggableColliders draggable) {
  const std::optional<ColliderHit> hit = context.collider_at(cursor);
  return hit && (hit->bounded || draggable == DraggableColliders::All) ? hit : std::nullopt;
}

bool ColliderDrag::begin(const glm::dvec2& cursor, DraggableColliders draggable, ToolContext& context) {
  *this = {};
  const std::optional<ColliderHit> hit = collider_to_drag(context, cursor, draggable);
  if (!hit) return false;
  collider_ = hit->collider;
  gesture_ = context.begin_gesture();
  place_ = hit->position;
  target_ = anchor_of(carried_collider(context.system(), context.snapshot().state, static_cast<std::size_t>(*collider_)));
  grab_offset_ = target_ - context.point_in_view_plane(cursor, place_);
  return true;
}

void ColliderDrag::follow(const glm::dvec2& cursor, ToolContext& context) {
  const System& system = context.system();
  if (!collider_ || *collider_ >= static_cast<Index>(system.colliders.size())) return;
  const Vec3 target = context.point_in_view_plane(cursor, place_) + grab_offset_;
  const bool moved = target != target_;
  target_ = target;
  if (context.status->run.running) {
    if (!std::exchange(has_hand_, true))
      context.lab.submit(GrabCollider{{*collider_, target_}}, gesture_);
    else if (moved)
      context.lab.submit(MoveHand{target_}, gesture_);
  } else {
    release(context);
    if (!moved) return;
    std::vector<Collider> colliders = carried_colliders(system, context.snapshot().state);
    Collider& mine = colliders[*collider_];
    mine = translated(mine, target_ - anchor_of(mine));
    context.lab.submit(SetColliders{std::move(colliders)}, gesture_);
    has_moved_ = true;
  }
}

void ColliderDrag::release(ToolContext& context) {
  if (!std::exchange(has_hand_, false)) return;
  context.lab.submit(ReleaseHand{}, gesture_);
  has_moved_ = true;
}

void ColliderDrag::end(ToolContext& context) {
  release(context);
  collider_.reset();
}

void ColliderDrag::revert(ToolContext& context) {
  end(context);
  if (std::exchange(has_moved_, false)) context.lab.submit(Undo{});
}

}  // namespace hooke
