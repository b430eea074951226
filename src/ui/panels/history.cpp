// The undo steps by name: clicking one undoes or redoes up to it.
#include "edit/history_list.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

constexpr double list_height = 180.0;  // [design units]

std::string sentence(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

// Row 0 is the state before every step.
std::string name_of(const HistoryList& history, std::size_t row) { return row == 0 ? "As opened" : sentence(history.names[row - 1]); }

}  // namespace

void build_history(const PanelInput& input, Requests& requests) {
  const HistoryList& history = *input.status.history.list;
  const std::string remark = history.names.empty() ? "" : std::to_string(history.done) + " of " + std::to_string(history.names.size());
  if (!section("History", remark, false)) return;

  ImGui::BeginChild("steps", {0.0f, units(list_height)});
  ImGui::PushStyleColor(ImGuiCol_Header, palette::tinted);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(history.names.size()) + 1);
  while (clipper.Step()) {
    for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
      const auto steps = static_cast<std::size_t>(row);
      ImGui::PushID(row);
      ImGui::PushStyleColor(ImGuiCol_Text, steps > history.done ? palette::dim : palette::text);
      if (ImGui::Selectable(name_of(history, steps).c_str(), steps == history.done)) requests.emplace_back(Control(GoToHistoryStep{steps}));
      ImGui::PopStyleColor();
      ImGui::PopID();
    }
  }
  clipper.End();
  // scroll to a new step
  int& seen = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("seen"), 0);
  if (const int now = static_cast<int>(history.done); seen != now) {
    seen = now;
    const float line = ImGui::GetTextLineHeightWithSpacing();
    ImGui::SetScrollFromPosY(static_cast<float>(now) * line - ImGui::GetScrollY() + 0.5f * line, 0.5f);
  }
  ImGui::PopStyleColor();
  ImGui::EndChild();
}

}  // namespace hooke
