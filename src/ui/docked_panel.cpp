#include "ui/docked_panel.h"

#include <algorithm>

#include "ui/widgets.h"

namespace hooke {
namespace {

constexpr double buttons_height = 30.0;  // [design units]

// Of the content in the last frame; 0 in the first.
float& content_height() { return *ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID("content"), 0.0f); }

}  // namespace

double left_panel_width(const PanelInput& input, const Panels& panels, double desired) {
  constexpr double edges = 3.0 * 14.0, min = 380.0;  // [design units]
  if (!panels.shown.accuracy) return desired;
  const double room = input.layout.scene.width / units(1.0) - accuracy_panel_width - edges;
  return room < min ? desired : std::min(desired, room);
}

DockedPanel::DockedPanel(const char* name, const Dock& dock, Panels& panels) : dock_(dock) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, dock.is_over_scene ? units(8.0) : 0.0f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(dock.is_over_scene ? 16.0 : 14.0), units(12.0)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, dock.is_over_scene ? 1.0f : 0.0f);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, palette::box);
  const ImVec2 size = extent(dock.place);
  ImGui::SetNextWindowPos(corner(dock.place));
  ImGui::SetNextWindowSizeConstraints({size.x, dock.is_over_scene ? 0.0f : size.y}, size);
  ImGui::Begin(name, nullptr, front_box | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  panels.shown.floating.push_back(current_window());
}

DockedPanel::~DockedPanel() {
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
}

void DockedPanel::begin_content() {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float below = units(buttons_height) + 3.0f * style.ItemSpacing.y + style.WindowPadding.y;
  const float room = std::max(1.0f, static_cast<float>(dock_.place.height) - ImGui::GetCursorPosY() - below);
  const float desired = content_height();
  ImGui::PushStyleColor(ImGuiCol_ChildBg, 0);
  ImGui::BeginChild("rows", {0.0f, dock_.is_over_scene && desired > 0.0f ? std::min(desired, room) : room});
}

void DockedPanel::end_content() {
  const float height = ImGui::GetCursorPosY();
  ImGui::EndChild();
  ImGui::PopStyleColor();
  content_height() = height;
  ImGui::Spacing();
}

}  // namespace hooke
