#include "app/tools/active_tool.h"

#include <algorithm>
#include <glm/common.hpp>

namespace hooke {

ActiveTool::ActiveTool(ToolContext& context) : context_(context) { take(Action::SelectTool); }

void ActiveTool::take(Action action) {
  if (tool_) tool_->cancel(context_);
  is_pressed_ = false;
  const auto rows = tools();
  tool_ = std::ranges::find(rows, action, &ToolRow::action)->make();
  action_ = action;
}

void ActiveTool::press(const Pointer& pointer) {
  if (std::exchange(is_pressed_, true)) return;
  tool_->press(pointer, context_);
}

void ActiveTool::release(const Pointer& pointer) {
  if (!std::exchange(is_pressed_, false)) return;
  context_.settle();
  tool_->release(pointer, context_);
}

void ActiveTool::follow(const Pointer& pointer) {
  if (is_pressed_) tool_->follow(pointer, context_);
}

bool ActiveTool::cancel() {
  is_pressed_ = false;
  return tool_->cancel(context_);
}

std::optional<Rect> ActiveTool::rubber_band(const Rect& view) const {
  const auto band = tool_->rubber_band();
  if (!band) return std::nullopt;
  const glm::dvec2 min = glm::min(band->first, band->second), max = glm::max(band->first, band->second);
  return Rect{view.x + min.x, view.y + min.y, max.x - min.x, max.y - min.y};
}

}  // namespace hooke
