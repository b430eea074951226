// A collider under the mouse, for the tools that can take one: while the scene runs it goes with the cursor and pushes what
// it meets; in a pause it is put there. One step of undo either way.
#pragma once

#include "app/workbench.h"

namespace hooke {

enum class Takes { Bounded, All };  // balls and boxes; planes, too

// Which a press would take.
std::optional<ColliderHit> collider_to_drag(const Workbench& bench, const glm::dvec2& cursor, Takes takes);

class ColliderDrag {
 public:
  // False: there is none under the cursor.
  bool begin(const glm::dvec2& cursor, Takes takes, Workbench& bench);
  void follow(const glm::dvec2& cursor, Workbench& bench);
  void end(Workbench& bench);
  void take_back(Workbench& bench);

  bool is_dragging() const { return collider_.has_value(); }
  std::optional<Index> collider() const { return collider_; }

 private:
  void let_go(Workbench& bench);

  std::optional<Index> collider_;
  Gesture gesture_ = 0;
  bool has_hand_ = false, has_moved_ = false;
  Vec3 place_{0.0};   // where it was taken
  Vec3 grasp_{0.0};   // from the cursor's place to the anchor
  Vec3 target_{0.0};  // of its anchor
};

}  // namespace hooke
