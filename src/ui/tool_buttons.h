// The tools as they stand in the tool bar, from the top.
#pragma once

#include <span>
#include <string_view>

#include "ui/icons.h"
#include "ui/shortcuts.h"

namespace hooke {

struct ToolButton {
  Action action;
  Icon icon;
  std::string_view name;  // short, under the sign
};

std::span<const ToolButton> tool_buttons();

}  // namespace hooke
