// The buttons of the toolbar, from the top.
#pragma once

#include <span>
#include <string_view>

#include "ui/actions.h"
#include "ui/icons.h"

namespace hooke {

struct ToolButton {
  Action action;
  Icon icon;
  std::string_view name;  // short, below the icon
};

std::span<const ToolButton> tool_buttons();

}  // namespace hooke
