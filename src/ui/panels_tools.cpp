// The tool bar at the left.
#include "ui/panels.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

// Sign, name under it, key in the corner.
bool tool_button(const ToolButton& tool, bool active) {
  const ImVec2 size{units(62.0), units(54.0)};
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool clicked = ImGui::InvisibleButton("tool", size);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 back = active ? palette::tinted : ImGui::IsItemActive() ? palette::pressed : ImGui::IsItemHovered() ? palette::hovered : 0;
  if (back != 0) list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, back, units(6.0));

  draw_icon(list, tool.icon, {at.x + 0.5f * size.x, at.y + units(20.0)}, units(20.0), active ? palette::accent : palette::text);
  ImGui::PushFont(fonts().small);
  const float width = ImGui::CalcTextSize(tool.name.data(), tool.name.data() + tool.name.size()).x;
  list.AddText({at.x + 0.5f * (size.x - width), at.y + units(37.0)}, active ? palette::text : palette::dim, tool.name.data(),
               tool.name.data() + tool.name.size());
  const std::string key = key_text(shortcut_of(tool.action));
  list.AddText({at.x + size.x - ImGui::CalcTextSize(key.c_str()).x - units(5.0), at.y + units(3.0)}, palette::dim, key.c_str());
  ImGui::PopFont();
  return clicked;
}

}  // namespace

void build_toolbar(const Desk& desk, Requests& requests) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(6.0), units(8.0)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {units(4.0), units(4.0)});
  begin_panel("tools", desk.layout.tools, ImGuiWindowFlags_NoScrollbar);
  for (const ToolButton& tool : desk.tools) {
    ImGui::PushID(static_cast<int>(tool.action));
    if (tool_button(tool, tool.action == desk.tool)) requests.emplace_back(tool.action);
    tooltip(tool.action);
    ImGui::PopID();
  }

  // not a tool: acts at once
  ImGui::Dummy({0.0f, units(2.0)});
  ImGui::Separator();
  ImGui::Dummy({0.0f, units(2.0)});
  if (tool_button({Action::ReleaseNails, Icon::Release, "Release"}, false)) requests.emplace_back(Action::ReleaseNails);
  tooltip(Action::ReleaseNails);
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace hooke
