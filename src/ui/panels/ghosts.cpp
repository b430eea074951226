// Runs beside the run, drawn as ghosts: their settings, and their distance from it over time.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/file_limits.h"
#include "lab/accuracy/accuracy_text.h"
#include "sim/methods/integrator.h"
#include "ui/docked_panel.h"
#include "ui/panels.h"
#include "ui/text.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

void swatch(ImU32 color) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetFrameHeight(), size = units(10.0);
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + 0.5f * (height - size)}, {at.x + size, at.y + 0.5f * (height + size)}, color,
                                            units(2.0));
  ImGui::SetCursorScreenPos({at.x + units(18.0), at.y});
}

// At the right edge of the row.
void distance_text(const CompanionStatus* ghost) {
  const std::string text = ghost == nullptr || (!ghost->positions && !ghost->has_diverged) ? std::string("-")
                           : ghost->has_diverged                                           ? std::string("diverged")
                                                                                           : length_text(ghost->distance);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(text.c_str()).x);
  ImGui::AlignTextToFramePadding();
  text_in(ghost != nullptr && ghost->has_diverged ? palette::bad : palette::text, text);
}

// A method and its substeps; returns whether they changed.
bool setting_row(Settings& settings, bool& is_removed) {
  bool has_changed = false;
  const Integrator& now = *settings.integrator;
  ImGui::SetNextItemWidth(units(112.0));
  const std::string name = now.short_name();
  if (ImGui::BeginCombo("##method", name.c_str(), ImGuiComboFlags_HeightLarge)) {
    for (const Integrator& method : integrators())
      if (ImGui::Selectable(method.label.data(), &method == &now) && &method != &now) {
        settings.integrator = &method;
        has_changed = true;
      }
    ImGui::EndCombo();
  }
  ImGui::SameLine();
  ImGui::SetNextItemWidth(units(92.0));
  int substeps = settings.substeps;
  if (ImGui::InputInt("##substeps", &substeps, 1, 10, ImGuiInputTextFlags_EnterReturnsTrue)) {
    settings.substeps = std::clamp(substeps, 1, max_substeps);
    has_changed = true;
  }
  tooltip("Substeps per frame");
  ImGui::SameLine();
  if (ImGui::Button("x")) is_removed = true;
  tooltip("Remove");
  return has_changed;
}

// The range of the nonzero distances, at most eight decades.
LogAxis axis_of(const CompanionTable& table) {
  LogAxis axis;
  for (const auto& distances : table.distances)
    for (const double distance : distances)
      if (distance > 1e-15 && std::isfinite(distance)) axis.include(distance);
  constexpr int most = 8;
  axis.min = std::max(axis.min, axis.max - most);
  return axis;
}

// Distance over time, on a logarithmic axis.
void chart(const CompanionTable& table, ImVec2 size) {
  const LogAxis axis = axis_of(table);
  if (table.times.size() < 2 || axis.is_empty) {
    dim_text(table.times.size() < 2 ? "Press Space to run the scene." : "No distance so far.");
    return;
  }
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("distances", size);
  const bool is_over = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 at{corner.x + units(54.0), corner.y + units(8.0)}, end{corner.x + size.x - units(8.0), corner.y + size.y - units(22.0)};
  const double first = table.times.front(), span = table.times.back() - first;
  const auto x_of = [&](double time) { return at.x + (end.x - at.x) * static_cast<float>((time - first) / span); };
  const auto y_of = [&](double distance) { return end.y - (end.y - at.y) * axis.fraction(distance); };
  ImGui::PushFont(fonts().small);
  draw_decades(list, axis, at, end, 4);
  const std::string begin_label = quantity_text(first, "s", 3), end_label = quantity_text(table.times.back(), "s", 3);
  list.AddText({at.x, end.y + units(4.0)}, palette::dim, begin_label.c_str());
  list.AddText({end.x - ImGui::CalcTextSize(end_label.c_str()).x, end.y + units(4.0)}, palette::dim, end_label.c_str());
  ImGui::PopFont();

  list.PushClipRect(at, end, true);
  const std::size_t step = 1 + table.times.size() / static_cast<std::size_t>(std::max(1.0f, end.x - at.x));
  for (std::size_t n = 0; n < table.distances.size(); ++n) {
    std::vector<ImVec2> line;
    for (std::size_t i = 0; i < table.times.size(); i += step)
      if (const double distance = table.distances[n][i]; distance > 0.0 && std::isfinite(distance))
        line.emplace_back(x_of(table.times[i]), y_of(distance));
    list.AddPolyline(line.data(), static_cast<int>(line.size()), ghost_color(n), 0, units(1.8));
  }
  list.PopClipRect();
  if (!is_over) return;
  const double time = first + span * std::clamp((ImGui::GetIO().MousePos.x - at.x) / (end.x - at.x), 0.0f, 1.0f);
  const auto after = std::ranges::lower_bound(table.times, time);
  const std::size_t i = std::min(static_cast<std::size_t>(after - table.times.begin()), table.times.size() - 1);
  std::string text = "t = " + quantity_text(table.times[i], "s");
  for (const auto& distances : table.distances) text += "\n" + (std::isfinite(distances[i]) ? length_text(distances[i]) : "diverged");
  ImGui::SetTooltip("%s", text.c_str());
}

}  // namespace

ImU32 ghost_color(std::size_t n) {
  // without blue and orange, which the strain of springs has
  constexpr std::array<std::size_t, 5> inks{2, 3, 4, 0, 5};
  return palette::inks[inks[n % inks.size()]];
}

void build_ghosts(const PanelInput& input, Panels& panels, Requests& requests) {
  Ghosts& ghosts = panels.ghosts;
  if (!ghosts.is_shown) return;
  DockedPanel panel("ghosts", dock_panel(input.layout, units(1.0), left_panel_width(input, panels, 372.0), 400.0), panels);
  strong_text("Compare side by side");
  panel.begin_content();
  const CompanionsStatus& status = input.status.companions;
  const auto ghost = [&](std::size_t n) { return n < status.list.size() ? &status.list[n] : nullptr; };
  dim_text("RMS distance from the run");
  bool has_changed = false;
  std::size_t n = 0;
  const bool has_reference = ghosts.with_reference;
  swatch(has_reference ? ghost_color(n) : 0);
  const std::string name = has_reference && ghost(n) != nullptr ? ghost(n)->name : "Reference";
  has_changed = ImGui::Checkbox((name + "###reference").c_str(), &ghosts.with_reference);
  tooltip("A very accurate run");
  if (has_reference) distance_text(ghost(n++));
  std::optional<std::size_t> removed;
  for (std::size_t i = 0; i < ghosts.settings.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    swatch(ghost_color(n));
    bool is_removed = false;
    has_changed = setting_row(ghosts.settings[i], is_removed) || has_changed;
    if (is_removed) removed = i;
    distance_text(ghost(n++));
    ImGui::PopID();
  }
  if (removed) ghosts.settings.erase(ghosts.settings.begin() + static_cast<std::ptrdiff_t>(*removed)), has_changed = true;
  ImGui::Spacing();
  if (status.table)
    chart(*status.table, {ImGui::GetContentRegionAvail().x, units(150.0)});
  else
    dim_text(n == 0 ? "Add a setting to compare with." : "Press Space to run the scene.");
  ImGui::Spacing();
  ImGui::PushFont(fonts().small);
  paragraph("All start together from the state at t = " + quantity_text(status.since, "s") + ", and again after each edit.", palette::dim);
  ImGui::PopFont();
  panel.end_content();

  ImGui::BeginDisabled(ghosts.settings.size() >= Ghosts::max_settings);
  if (ImGui::Button("Add", {units(54.0), units(30.0)})) {
    Settings added = ghosts.settings.empty() ? input.status.snapshot->settings : ghosts.settings.back();
    added.substeps = std::min(2 * added.substeps, max_substeps);
    ghosts.settings.push_back(added);
    has_changed = true;
  }
  ImGui::EndDisabled();
  tooltip("Another setting, as a ghost");
  ImGui::SameLine();
  if (ImGui::Button("Restart", {units(72.0), units(30.0)})) has_changed = true;
  tooltip("Start all ghosts from the present state");
  if (close_button()) ghosts = {}, has_changed = true;
  if (has_changed) requests.emplace_back(SetGhosts{ghosts.with_reference, ghosts.settings});
}

}  // namespace hooke
