#include "ui/actions.h"

#include <array>

namespace hooke {
namespace {

constexpr std::array rows{
#define TOOL(id, keys, icon, name, text, make) ActionRow{Action::id, keys, no_menu, Needs::Scene, "Tools", text},
#define ACTION(id, keys, position, needs, group, text, ...) ActionRow{Action::id, keys, position, needs, group, text},
#include "ui/actions.inc"
};

constexpr std::array button_rows{
#define TOOL(id, keys, icon, name, text, make) ToolButton{Action::id, Icon::icon, name},
#define ACTION(...)
#include "ui/actions.inc"
};

}  // namespace

std::span<const ToolButton> tool_buttons() { return button_rows; }

std::span<const ActionRow> actions() { return rows; }

// Rows are in the order of the enumeration: both are made from the same file.
const ActionRow& row_of(Action action) { return rows[static_cast<std::size_t>(action)]; }

}  // namespace hooke
