#include "ui/widgets.h"

namespace hooke {

Rect current_window() {
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  return {at.x, at.y, size.x, size.y};
}

bool begin_panel(const char* name, const Rect& place, ImGuiWindowFlags flags) {
  ImGui::SetNextWindowPos(corner(place));
  ImGui::SetNextWindowSize(extent(place));
  return ImGui::Begin(name, nullptr, fixed_panel | flags);
}

bool icon_button(const char* id, Icon icon, ImVec2 size, bool active, bool enabled) {
  ImGui::BeginDisabled(!enabled);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool clicked = ImGui::InvisibleButton(id, size);
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 back = active ? palette::tinted : ImGui::IsItemActive() ? palette::pressed : hovered ? palette::hovered : 0;
  if (back != 0) list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, back, units(5.0));
  const ImU32 ink = !enabled ? palette::pressed : active ? palette::accent : palette::text;
  draw_icon(list, icon, {at.x + 0.5f * size.x, at.y + 0.5f * size.y}, units(15.0), ink);
  ImGui::EndDisabled();
  return clicked && enabled;
}

void tooltip(const std::string& text) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(8.0), units(6.0)});
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(units(280.0));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

void tooltip(Action action, const std::string& detail) {
  const Shortcut& row = shortcut_of(action);
  tooltip(std::string(row.text) + (detail.empty() ? "" : ": " + detail) + "   " + key_text(row));
}

void text_in(ImU32 color, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

void dim_text(const std::string& text) { text_in(palette::dim, text); }

}  // namespace hooke
