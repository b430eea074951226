// What the time per frame is spent on, with a small history of each phase.
#include <array>
#include <cfloat>
#include <deque>
#include <string>

#include "ui/docked_panel.h"
#include "ui/number_field.h"
#include "ui/panels.h"
#include "ui/text.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

constexpr std::size_t max_history = 240;  // frames of the window, some seconds

void plot(const std::deque<float>& history, ImVec2 size) {
  const auto value = [](void* of, int i) { return (*static_cast<const std::deque<float>*>(of))[static_cast<std::size_t>(i)]; };
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.0f, units(2.0)});
  ImGui::PushStyleColor(ImGuiCol_PlotLines, palette::accent);
  ImGui::PlotLines("", value, const_cast<std::deque<float>*>(&history), static_cast<int>(history.size()), 0, nullptr, 0.0f, FLT_MAX, size);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
}

}  // namespace

void build_times(const PanelInput& input, Panels& panels) {
  if (!panels.times.is_shown) return;
  DockedPanel panel("times", dock_panel(input.layout, units(1.0), left_panel_width(input, panels, 420.0), 400.0), panels);
  strong_text("Time per frame");
  panel.begin_content();
  const std::array rows{std::pair{"Draw", "The window, for each of its frames"},
                        std::pair{"Forces", "Forces, and all of a step that is not in another row"},
                        std::pair{"Contact", "Contact with colliders, faces and other springs, and friction"},
                        std::pair{"Implicit solve", "Matrices of implicit methods: their assembly, factors and solutions"},
                        std::pair{"Auto", "What `auto` computes to choose method and substeps, and does not keep"},
                        std::pair{"Accuracy", "Runs that measure the error, most of them in idle time"}};
  static_assert(rows.size() == phase_count);
  for (std::size_t i = 0; i < phase_count; ++i) {
    const double ms = i == 0 ? input.draw_ms : input.status.run.phase_ms[i];
    std::deque<float>& history = panels.times.history[i];
    if (input.status.run.running) history.push_back(static_cast<float>(ms));
    if (history.size() > max_history) history.pop_front();
    begin_row(rows[i].first);
    tooltip(rows[i].second);
    ImGui::PushID(static_cast<int>(i));
    plot(history, {units(150.0), ImGui::GetTextLineHeight() + units(4.0)});
    ImGui::PopID();
    ImGui::SameLine();
    ImGui::TextUnformatted(milliseconds_text(ms).c_str());
  }
  panel.end_content();
  if (ImGui::Button("Close", {units(96.0), units(30.0)})) panels.times.is_shown = false;
}

}  // namespace hooke
