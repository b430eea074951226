// A collider under the mouse, for the tools that can take one: while the scene runs it goes with the cursor and pushes what
// it meets; in a pause it is put there. One step of undo either way.
#pragma once

#include "app/tools/tool_context.h"

namespace hooke {

enum class DraggableColliders { Bounded, All };  // balls and boxes; planes, too

// Which a press would take.
std::optional<ColliderHit> collider_to_drag(const ToolContext& context, const glm::dvec2& cursor, DraggableColliders draggable);

class ColliderDrag {
 public:
  // False: there is none under the cursor.
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
  Vec3 place_{0.0};        // where it was taken
  Vec3 grab_offset_{0.0};  // from the cursor's place to the anchor
  Vec3 target_{0.0};       // of its anchor
};

}  // namespace hooke
