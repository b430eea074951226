// The command palette: type part of a name, Enter chooses.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "ui/panels.h"
#include "ui/search_results.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

constexpr double search_width = 460.0, row_height = 26.0;  // [design units]
constexpr std::size_t max_rows = 9;

// A field that gets the keyboard selects its text: what the program put there is to be continued instead.
int keep_text(ImGuiInputTextCallbackData* data) {
  auto& search = *static_cast<Search*>(data->UserData);
  if (!std::exchange(search.continues_text, false)) return 0;
  data->ClearSelection();
  data->CursorPos = data->BufTextLen;
  return 0;
}

void search_field(Search& search) {
  if (std::exchange(search.is_new, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::PushID(search.text_version);
  if (ImGui::InputTextWithHint("##typed", "Commands, scenes, parts, parameters: friction 0", &search.typed,
                               ImGuiInputTextFlags_CallbackAlways, keep_text, &search))
    search.highlighted = 0;
  ImGui::PopID();
}

// Returns whether it was clicked.
bool row(const SearchResult& result, bool highlighted) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool clicked = ImGui::Selectable("##row", highlighted, 0, {0.0f, units(row_height)});
  if (highlighted && !ImGui::IsItemVisible()) ImGui::SetScrollHereY(0.5f);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float y = at.y + 0.5f * (units(row_height) - ImGui::GetFontSize()), end = at.x + ImGui::GetContentRegionAvail().x;
  const float remark = end - ImGui::CalcTextSize(result.remark.c_str()).x - units(6.0);
  list.PushClipRect(at, {remark - units(8.0), at.y + units(row_height)}, true);
  list.AddText({at.x + units(6.0), y}, palette::text, result.text.c_str());
  list.PopClipRect();
  list.AddText({remark, y}, palette::dim, result.remark.c_str());
  return clicked;
}

// Returns the one that was clicked; null: none.
SearchResult* result_rows(std::vector<SearchResult>& found, const Search& search, const Layout& layout) {
  SearchResult* clicked = nullptr;
  const double available =
      (layout.page.y + layout.page.height) / units(row_height) - ImGui::GetCursorScreenPos().y / units(row_height) - 0.7;
  const auto rows_that_fit = static_cast<std::size_t>(std::clamp(available, 1.0, static_cast<double>(max_rows)));
  ImGui::BeginChild("found", {0.0f, units(row_height) * static_cast<float>(std::min(found.size(), rows_that_fit))});
  ImGui::PushStyleColor(ImGuiCol_Header, palette::tinted);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {units(8.0), 0.0f});
  for (std::size_t i = 0; i < found.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (row(found[i], static_cast<int>(i) == search.highlighted)) clicked = &found[i];
    ImGui::PopID();
  }
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  ImGui::EndChild();
  return clicked;
}

void choose(SearchResult& chosen, Search& search, Requests& requests) {
  if (!chosen.typed.empty()) {
    // the field is created anew: the one that has the keyboard would keep its own text
    search.typed = chosen.typed;
    ++search.text_version;
    search.is_new = search.continues_text = true;
    return;
  }
  search.shown = false;
  for (Request& request : chosen.requests) requests.push_back(std::move(request));
}

}  // namespace

void build_search(const PanelInput& input, Panels& panels, Requests& requests) {
  Search& search = panels.search;
  if (!search.shown) return;
  const Rect& scene = input.layout.scene;
  const float wide = box_width(search_width);
  ImGui::SetNextWindowPos({middle_for(scene, wide), static_cast<float>(scene.y) + units(24.0)}, ImGuiCond_Always, {0.5f, 0.0f});
  ImGui::SetNextWindowSize({wide, 0.0f});
  begin_front_box("search", {units(12.0), units(12.0)});
  panels.shown.floating.push_back(current_window());

  search_field(search);
  std::vector<SearchResult> found = find_results(input, search.typed);
  search.highlighted += input.presses(PanelKey::Target::Search, Key::Down) - input.presses(PanelKey::Target::Search, Key::Up);
  search.highlighted = std::clamp(search.highlighted, 0, std::max(0, static_cast<int>(found.size()) - 1));
  const bool accepted = input.presses(PanelKey::Target::Search, Key::Enter) > 0;
  SearchResult* chosen = accepted && !found.empty() ? &found[static_cast<std::size_t>(search.highlighted)] : nullptr;
  if (found.empty()) {
    dim_text("No matching command");
    // Enter would take the keyboard from the field
    if (accepted) search.is_new = search.continues_text = true;
  } else if (SearchResult* clicked = result_rows(found, search, input.layout)) {
    chosen = clicked;
  }

  // a click elsewhere closes it
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_RootAndChildWindows)) search.shown = false;
  end_front_box();
  if (chosen != nullptr) choose(*chosen, search, requests);
}

}  // namespace hooke
