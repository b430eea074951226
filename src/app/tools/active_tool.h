// The active tool of the left mouse button, and whether the button is down.
#pragma once

#include "app/tools/tools.h"
#include "ui/layout.h"

namespace hooke {

class ActiveTool {
 public:
  explicit ActiveTool(ToolContext& context);

  // Cancels what the previous tool had begun.
  void take(Action action);
  void reset() { take(action_); }

  void press(const Pointer& pointer);
  void release(const Pointer& pointer);
  // Once per frame.
  void follow(const Pointer& pointer);
  // Returns false if there was nothing to cancel.
  bool cancel();

  Action action() const { return action_; }
  bool is_pressed() const { return is_pressed_; }
  std::string next_step() const { return tool_->next_step(context_); }
  void mark(const Pointer& pointer, Marks& marks) const { tool_->mark(pointer, context_, marks); }
  // In window coordinates.
  std::optional<Rect> rubber_band(const Rect& view) const;
  std::vector<glm::dvec2> stroke() const { return tool_->stroke(); }

 private:
  ToolContext& context_;
  std::unique_ptr<Tool> tool_;
  Action action_ = Action::SelectTool;
  bool is_pressed_ = false;
};

}  // namespace hooke
