// The command palette: type part of a command's name, Enter runs it. Made from the table of commands.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <sstream>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

constexpr double width = 460.0, row_height = 26.0;  // [design units]
constexpr std::size_t max_rows = 9;

std::string lower(std::string_view text) {
  std::string low(text);
  std::ranges::transform(low, low.begin(),
                         [](unsigned char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : static_cast<char>(c); });
  return low;
}

// The quality of a match; 0 is none. Each typed word must occur in the command or its group.
int match(const Shortcut& row, const std::string& typed) {
  const std::string text = lower(row.text), all = text + " " + lower(row.group);
  std::istringstream words(lower(typed));
  int score = 1;
  for (std::string word; words >> word;) {
    const std::size_t at = all.find(word);
    if (at == std::string::npos) return 0;
    if (at == 0) score += 2;
    if (at > 0 && all[at - 1] == ' ') score += 1;
  }
  return score;
}

}  // namespace

std::vector<const Shortcut*> find_commands(const std::string& typed) {
  std::vector<std::pair<int, const Shortcut*>> scored;
  for (const Shortcut& row : shortcuts()) {
    const int score = match(row, typed);
    // each action once, with its first key
    if (score > 0 && &shortcut_of(row.action) == &row) scored.emplace_back(score, &row);
  }
  std::ranges::stable_sort(scored, std::ranges::greater(), &std::pair<int, const Shortcut*>::first);
  std::vector<const Shortcut*> found;
  for (const auto& [score, row] : scored) found.push_back(row);
  return found;
}

void build_search(const PanelInput& input, Panels& panels, Requests& requests) {
  Search& search = panels.search;
  if (!search.shown) return;
  const Rect& scene = input.layout.scene;
  const float wide = box_width(width);
  ImGui::SetNextWindowPos({middle_for(scene, wide), static_cast<float>(scene.y) + units(24.0)}, ImGuiCond_Always, {0.5f, 0.0f});
  ImGui::SetNextWindowSize({wide, 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, units(8.0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(12.0), units(12.0)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, palette::box);
  ImGui::Begin("search", nullptr, front_box);
  panels.floating.push_back(current_window());

  if (std::exchange(search.is_new, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::InputTextWithHint("##typed", "Search commands", &search.typed)) search.highlighted = 0;

  const std::vector<const Shortcut*> found = find_commands(search.typed);
  search.highlighted += input.presses(PanelKey::Target::Search, Key::Down) - input.presses(PanelKey::Target::Search, Key::Up);
  search.highlighted = std::clamp(search.highlighted, 0, std::max(0, static_cast<int>(found.size()) - 1));
  const bool accepted = input.presses(PanelKey::Target::Search, Key::Enter) > 0;
  const Shortcut* chosen = accepted && !found.empty() ? found[static_cast<std::size_t>(search.highlighted)] : nullptr;
  if (found.empty()) dim_text("No matching command");

  const double available =
      (input.layout.page.y + input.layout.page.height) / units(row_height) - ImGui::GetCursorScreenPos().y / units(row_height) - 0.7;
  const auto rows_that_fit = static_cast<std::size_t>(std::clamp(available, 1.0, static_cast<double>(max_rows)));
  ImGui::BeginChild("found", {0.0f, units(row_height) * static_cast<float>(std::min(found.size(), rows_that_fit))});
  ImGui::PushStyleColor(ImGuiCol_Header, palette::tinted);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {units(8.0), 0.0f});
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Shortcut& row = *found[i];
    ImGui::PushID(static_cast<int>(row.action));
    const bool highlighted = static_cast<int>(i) == search.highlighted;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::Selectable("##row", highlighted, 0, {0.0f, units(row_height)})) chosen = &row;
    if (highlighted && !ImGui::IsItemVisible()) ImGui::SetScrollHereY(0.5f);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float y = at.y + 0.5f * (units(row_height) - ImGui::GetFontSize()), end = at.x + ImGui::GetContentRegionAvail().x;
    list.AddText({at.x + units(6.0), y}, palette::text, row.text.data(), row.text.data() + row.text.size());
    const std::string key = key_text(row);
    list.AddText({end - ImGui::CalcTextSize(key.c_str()).x - units(6.0), y}, palette::dim, key.c_str());
    ImGui::PopID();
  }
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  ImGui::EndChild();

  // a click elsewhere closes it
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_RootAndChildWindows)) search.shown = false;
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
  if (chosen == nullptr) return;
  search.shown = false;
  requests.emplace_back(chosen->action);
}

}  // namespace hooke
