#include "app/tools.h"

#include <array>

namespace hooke {
namespace {

constexpr std::array rows{
    ToolRow{{Action::SelectTool, Icon::Select, "Select"}, make_select_tool},
    ToolRow{{Action::AddTool, Icon::Add, "Add"}, make_add_tool},
    ToolRow{{Action::AttachTool, Icon::Attach, "Attach"}, make_attach_tool},
    ToolRow{{Action::NailTool, Icon::Nail, "Nail"}, make_nail_tool},
    ToolRow{{Action::DragTool, Icon::Drag, "Drag"}, make_drag_tool},
    ToolRow{{Action::DeleteTool, Icon::Delete, "Delete"}, make_delete_tool},
};

}  // namespace

std::span<const ToolRow> tools() { return rows; }

}  // namespace hooke
