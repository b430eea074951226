// The toolbar on the left.
#include <algorithm>
#include <cmath>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

constexpr double full_height = 54.0, named_height = 46.0, min_height = 22.0, button_gap = 4.0, button_margin = 8.0;  // [design units]

// The height of a button [design units] at which all fit.
double height_for(const Rect& bar, std::size_t tools) {
  const double available = bar.height / units(1.0) - 2.0 * button_margin - 2.0 * (2.0 + button_gap) - (1.0 + button_gap);
  return std::clamp(std::floor(available / static_cast<double>(tools + 1)) - button_gap, min_height, full_height);
}

// Icon, name below it if there is space, key in the corner.
bool tool_button(const ToolButton& tool, bool active, double height) {
  const ImVec2 size{units(62.0), units(height)};
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool clicked = ImGui::InvisibleButton("tool", size), is_named = height >= named_height;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 back = active ? palette::tinted : ImGui::IsItemActive() ? palette::pressed : ImGui::IsItemHovered() ? palette::hovered : 0;
  if (back != 0) list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, back, units(6.0));

  draw_icon(list, tool.icon, {at.x + 0.5f * size.x, at.y + (is_named ? units(0.37 * height) : 0.5f * size.y)},
            units(std::min(20.0, 0.7 * height)), active ? palette::accent : palette::text);
  ImGui::PushFont(fonts().small);
  const float width = ImGui::CalcTextSize(tool.name.data(), tool.name.data() + tool.name.size()).x;
  if (is_named)
    list.AddText({at.x + 0.5f * (size.x - width), at.y + size.y - units(17.0)}, active ? palette::text : palette::dim, tool.name.data(),
                 tool.name.data() + tool.name.size());
  const std::string key = key_text(shortcut_of(tool.action));
  list.AddText({at.x + size.x - ImGui::CalcTextSize(key.c_str()).x - units(5.0), at.y + units(3.0)}, palette::dim, key.c_str());
  ImGui::PopFont();
  return clicked;
}

}  // namespace

void build_toolbar(const PanelInput& input, Requests& requests) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(6.0), units(button_margin)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {units(4.0), units(button_gap)});
  begin_panel("tools", input.layout.tools, ImGuiWindowFlags_NoScrollbar);
  const double height = height_for(input.layout.tools, input.tool.buttons.size());
  for (const ToolButton& tool : input.tool.buttons) {
    ImGui::PushID(static_cast<int>(tool.action));
    if (tool_button(tool, tool.action == input.tool.action, height)) requests.emplace_back(tool.action);
    tooltip(tool.action);
    ImGui::PopID();
  }

  // not a tool: acts immediately
  ImGui::Dummy({0.0f, units(2.0)});
  ImGui::Separator();
  ImGui::Dummy({0.0f, units(2.0)});
  if (tool_button({Action::ReleaseNails, Icon::Release, "Release"}, false, height)) requests.emplace_back(Action::ReleaseNails);
  tooltip(Action::ReleaseNails);
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace hooke
