#include "app/tools/tools.h"

#include <array>

namespace hooke {
namespace {

constexpr std::array tool_rows{
#define TOOL(id, keys, icon, name, text, make) ToolRow{Action::id, make},
#define ACTION(...)
#include "ui/actions.inc"
};

}  // namespace

std::span<const ToolRow> tools() { return tool_rows; }

}  // namespace hooke
