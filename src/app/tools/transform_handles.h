// Handles around several selected points: the corners of a box scale them about their center, the round one above it turns them.
#pragma once

#include <optional>

#include "app/tools/tools.h"
#include "edit/arrange.h"

namespace hooke {

class TransformHandles {
 public:
  // Returns false if no handle is under the cursor.
  bool begin(const Pointer& pointer, ToolContext& context);
  void follow(const Pointer& pointer, ToolContext& context);
  void revert(ToolContext& context);
  // "turned by 12 degrees"
  const std::string& text() const { return text_; }
  void mark(const ToolContext& context, Marks& marks) const;

 private:
  std::shared_ptr<const Snapshot> start_;  // at the start of the drag; null: nothing is dragged
  std::vector<PointId> points_;
  glm::dvec2 pressed_at_{0.0};
  bool turns_ = false, has_moved_ = false;
  Gesture gesture_ = 0;
  std::string text_;
};

}  // namespace hooke
