// The F1 overlay: every shortcut of the table, by group, and what the mouse does.
#include "ui/panels.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

void heading(std::string_view title) {
  ImGui::Dummy({0.0f, units(3.0)});
  ImGui::PushFont(fonts().strong);
  text_in(palette::accent, std::string(title));
  ImGui::PopFont();
}

void line(const std::string& key, std::string_view text, float indent) {
  ImGui::TextUnformatted(key.c_str());
  ImGui::SameLine(indent);
  dim_text(std::string(text));
}

// The column in which a group stands.
bool is_left(std::string_view group) { return group == "Tools" || group == "Run" || group == "Tune"; }

void key_column(bool left) {
  std::string_view group;
  for (const Shortcut& row : shortcuts()) {
    if (is_left(row.group) != left) continue;
    if (row.group != group) heading(group = row.group);
    line(key_text(row), row.text, units(112.0));
  }
}

}  // namespace

void build_keys(const Desk& desk, Panels& panels) {
  if (!panels.keys_shown) return;
  const Rect& scene = desk.layout.scene;
  ImGui::SetNextWindowPos({static_cast<float>(scene.x + 0.5 * scene.width), static_cast<float>(scene.y + 0.5 * scene.height)},
                          ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({units(640.0), 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, units(8.0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(24.0), units(16.0)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, palette::box);
  ImGui::Begin("keys", nullptr, fixed_panel | ImGuiWindowFlags_AlwaysAutoResize);
  panels.floating.push_back(current_window());

  ImGui::Columns(2, "columns", false);
  key_column(true);
  ImGui::NextColumn();
  key_column(false);
  ImGui::Columns(1);
  heading("Mouse");
  for (const MouseHint& hint : mouse_hints()) line(std::string(hint.gesture), hint.text, units(220.0));

  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
}

}  // namespace hooke
