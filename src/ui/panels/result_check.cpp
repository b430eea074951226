// How far the result depends on the step and on the resolution: a sentence and a table.
#include <array>

#include "ui/docked_panel.h"
#include "ui/panels.h"
#include "ui/text.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

void table(const ResultCheck& check) {
  const bool has_finer = check.why_not_finer.empty();
  if (!ImGui::BeginTable("quantities", has_finer ? 4 : 3, ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_SizingStretchProp)) return;
  const auto cell = [](const std::string& text, ImU32 color = palette::text) {
    ImGui::TableNextColumn();
    text_in(color, text);
  };
  ImGui::TableNextRow();
  for (const char* heading : {"", "now", "half the step"}) cell(heading, palette::dim);
  if (has_finer) cell("and twice the resolution", palette::dim);
  for (const CheckedQuantity& quantity : check.quantities) {
    ImGui::TableNextRow();
    std::string name(quantity.name);
    name[0] = static_cast<char>(name[0] - 'a' + 'A');
    cell(name, palette::dim);
    if (!quantity.now && !quantity.half_step && !quantity.finer) {
      cell(quantity.why_unknown, palette::dim);
      continue;
    }
    const auto value = [&](const std::optional<double>& each, bool differs) {
      cell(each ? value_text(quantity, *each) : "-", differs ? palette::warning : palette::text);
      if (!each) tooltip(quantity.why_unknown);
    };
    value(quantity.now, false);
    value(quantity.half_step, depends(quantity, quantity.now, quantity.half_step));
    if (has_finer) value(quantity.finer, depends(quantity, quantity.half_step, quantity.finer));
  }
  ImGui::EndTable();
}

void buttons(const ResultStatus<ResultCheck>& status, Panels& panels, Requests& requests) {
  if (status.is_running) {
    if (ImGui::Button("Cancel", {units(84.0), units(30.0)})) requests.emplace_back(StopResultCheck{});
  } else if (ImGui::Button("Check again", {units(104.0), units(30.0)})) {
    requests.emplace_back(Action::CheckResult);
  }
  if (status.result && !status.result->quantities.empty()) {
    ImGui::SameLine();
    if (ImGui::Button("Copy", {units(54.0), units(30.0)})) {
      ImGui::SetClipboardText(format_table(*status.result).c_str());
      panels.show_toast("Copied the table");
    }
  }
  if (close_button()) {
    panels.shown.result_check = false;
    requests.emplace_back(StopResultCheck{});
  }
}

}  // namespace

void build_result_check(const PanelInput& input, Panels& panels, Requests& requests) {
  if (!panels.shown.result_check) return;
  DockedPanel panel("result_check", dock_panel(input.layout, units(1.0), left_panel_width(input, panels, 500.0), 400.0), panels);
  strong_text("Check this result");
  panel.begin_content();
  const ResultStatus<ResultCheck>& status = input.results.result_check;
  if (status.is_running) {
    paragraph(
        "Runs copies of the scene from its present state: with the same step, with half of it, and with half of it and twice the "
        "resolution of sheets and ropes.",
        palette::dim);
    progress_bar(status.fraction, status.seconds, ImGui::GetContentRegionAvail().x);
  } else if (!status.result) {
    dim_text("Nothing checked yet.");
  } else {
    paragraph(status.result->sentence());
    ImGui::Spacing();
    if (!status.result->quantities.empty()) {
      table(*status.result);
      ImGui::Spacing();
      ImGui::PushFont(fonts().small);
      paragraph(
          "Sag and period of springs and weight alone, as the method computes them; maximum strain and change of the energy, with its part "
          "of what was supplied, within " +
              quantity_text(status.result->seconds, "s", 3) + " from the present state.",
          palette::dim);
      ImGui::PopFont();
    }
  }
  panel.end_content();
  buttons(status, panels, requests);
}

}  // namespace hooke
