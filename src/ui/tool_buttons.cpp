#include "ui/tool_buttons.h"

#include <array>

namespace hooke {
namespace {

constexpr std::array button_rows{
#define TOOL(id, keys, icon, name, text, make) ToolButton{Action::id, Icon::icon, name},
#define ACTION(...)
#include "ui/actions.inc"
};

}  // namespace

std::span<const ToolButton> tool_buttons() { return button_rows; }

}  // namespace hooke
