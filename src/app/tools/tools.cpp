#include "app/tools/tools.h"

#include <array>

namespace hooke {
namespace {

constexpr std::array rows{
    ToolRow{Action::SelectTool, make_select_tool}, ToolRow{Action::AddTool, make_add_tool},   ToolRow{Action::AttachTool, make_attach_tool},
    ToolRow{Action::NailTool, make_nail_tool},     ToolRow{Action::DragTool, make_drag_tool}, ToolRow{Action::CutTool, make_cut_tool},
    ToolRow{Action::DeleteTool, make_delete_tool},
};

}  // namespace

std::span<const ToolRow> tools() { return rows; }

}  // namespace hooke
