// Dragging of colliders, for the tools that support it: in a running scene the collider follows the cursor and pushes points in its path;
// in a paused one it is placed there. In both cases a drag is one undo step.
#pragma once

#include "app/tools/tool_context.h"

namespace hooke {

enum class DraggableColliders { Bounded, All };  // spheres and boxes; planes too

// The collider that a press would grab.
std::optional<ColliderHit> collider_to_drag(const ToolContext& context, const glm::dvec2& cursor, DraggableColliders draggable);

class ColliderDrag {
 public:
  // Returns false if there is none under the cursor.
  bool begin(const glm::dvec2& cursor, DraggableColliders draggable, ToolContext& context);
  void follow(const glm::dvec2& cursor, ToolContext& context);
  void end(ToolContext& context);
  void revert(ToolContext& context);

  bool is_dragging() const { return collider_.has_value(); }
  std::optional<Index> collider() const { return collider_; }

 private:
  void release(ToolContext& context);

  std::optional<Index> collider_;
  Gesture gesture_ = 0;
  bool has_hand_ = false, has_moved_ = false;
  Vec3 place_{0.0};        // position where it was grabbed
  Vec3 grab_offset_{0.0};  // from the cursor to the anchor
  Vec3 target_{0.0};       // of the anchor
};

}  // namespace hooke
