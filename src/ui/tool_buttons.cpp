#include "ui/tool_buttons.h"

#include <array>

namespace hooke {
namespace {

constexpr std::array rows{
    ToolButton{Action::SelectTool, Icon::Select, "Select"}, ToolButton{Action::AddTool, Icon::Add, "Add"},
    ToolButton{Action::AttachTool, Icon::Attach, "Attach"}, ToolButton{Action::NailTool, Icon::Nail, "Nail"},
    ToolButton{Action::DragTool, Icon::Drag, "Drag"},       ToolButton{Action::CutTool, Icon::Cut, "Cut"},
    ToolButton{Action::DeleteTool, Icon::Delete, "Delete"},
};

}  // namespace

std::span<const ToolButton> tool_buttons() { return rows; }

}  // namespace hooke
