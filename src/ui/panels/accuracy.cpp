// The accuracy of the run: a line below the method, and a panel with its four quantities, each with its unit and what it means.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "lab/accuracy/accuracy_text.h"
#include "scene/parameters.h"
#include "sim/methods/integrator.h"
#include "ui/docked_panel.h"
#include "ui/number_field.h"
#include "ui/panels.h"
#include "ui/text.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

void heading(const char* text) {
  ImGui::Dummy({0.0f, units(4.0)});
  strong_text(text);
}

void explanation(const char* text) {
  ImGui::PushFont(fonts().small);
  paragraph(text, palette::dim);
  ImGui::PopFont();
}

void value_row(const char* name, const std::string& value, ImU32 color = palette::text) {
  dim_text(name);
  ImGui::SameLine(units(112.0));
  paragraph(value, color);
}

void error_section(const Accuracy& accuracy) {
  const Judgement judgement = judge(accuracy);
  if (judgement.level != Judgement::Level::Good) paragraph(judgement.text, color_of(judgement));
  heading("Error of a frame");
  value_row("RMS", error_text(accuracy.frame, accuracy.size));
  value_row("Maximum", error_text(accuracy.frame_max, accuracy.size));
  if (accuracy.frame.value) value_row("Measured", "at " + quantity_text(accuracy.frame_time, "s"));
  explanation(
      "How far the method moves the points away from the exact motion within one frame; some frames are repeated with half the step.");
  heading("Accumulated error");
  value_row("RMS", error_text(accuracy.accumulated, accuracy.size));
  if (accuracy.accumulated.value)
    value_row("Since", quantity_text(accuracy.since, "s") + ", known to " + quantity_text(accuracy.accumulated_time, "s"));
  explanation("Distance from a second run with half the step, computed in idle time.");
}

void predictability_section(const Accuracy& accuracy) {
  heading("Predictability");
  const bool is_chaotic = accuracy.growth_rate.value && *accuracy.growth_rate.value > 0.0;
  paragraph(predictability_text(accuracy));
  if (is_chaotic)
    value_row("Growth", "e-fold every " + quantity_text(1.0 / *accuracy.growth_rate.value, "s", 2));
  else if (accuracy.amplification.value)
    value_row("Growth", number_text(*accuracy.amplification.value, 2) + "-fold within a second, but not exponential");
  explanation("How fast a tiny difference at the start grows. Past this time no method predicts where the points are.");
}

struct Term {
  const char* name;
  double value;  // [J]
};

// A bar to the right of the middle for energy gained, to the left for energy lost.
void energy_row(const Term& term, double scale) {
  dim_text(term.name);
  ImGui::SameLine(units(112.0));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = units(52.0), height = ImGui::GetTextLineHeight(), middle = at.x + width;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float length = scale > 0.0 ? width * static_cast<float>(std::clamp(term.value / scale, -1.0, 1.0)) : 0.0f;
  list.AddRectFilled({std::min(middle, middle + length), at.y + units(3.0)},
                     {std::max(middle, middle + length), at.y + height - units(2.0)}, term.value < 0.0 ? palette::warning : palette::good,
                     units(2.0));
  list.AddLine({middle, at.y}, {middle, at.y + height}, palette::line);
  ImGui::SetCursorScreenPos({at.x + 2.0f * width + units(10.0), at.y});
  ImGui::TextUnformatted(quantity_text(term.value, "J", 3).c_str());
}

void energy_section(const Accuracy& accuracy) {
  heading("Energy balance");
  using enum EnergyCause;
  const EnergyBalance& balance = accuracy.energy;
  const EnergyLedger& ledger = balance.ledger;
  const std::array terms{
      Term{"Hand", ledger[Hand]},       Term{"Edits", ledger[Edits]},         Term{"Forces", ledger.forces()},
      Term{"Muscles", ledger[Muscles]}, Term{"Colliders", ledger[Colliders]}, Term{"Limits", ledger.limits()},
      Term{"Drag", ledger[Drag]},       Term{"Dashpots", ledger[Dashpots]},   Term{"Contact", ledger[Contact]},
  };
  double scale = std::max(std::abs(balance.change), std::abs(balance.method()));
  for (const Term& term : terms) scale = std::max(scale, std::abs(term.value));
  for (const Term& term : terms)
    if (term.value != 0.0) energy_row(term, scale);
  energy_row({"Method", balance.method()}, scale);
  energy_row({"Sum", balance.change}, scale);
  explanation(
      "Energy gained and lost since the start; what no force explains is due to the method. A closed balance does not prove that the "
      "motion is right.");
}

// A row of tested settings with a button that takes them.
void advice_row(const std::optional<TestedCost>& tested, const Settings& present, Requests& requests) {
  if (!tested) return;
  const Settings& settings = tested->settings;
  const std::string text = describe(*tested, present);
  paragraph(text);
  same_line_for("Use");
  if (!ImGui::SmallButton(("Use##" + text).c_str())) return;
  const bool changes_method = settings.integrator != present.integrator;
  if (changes_method) requests.emplace_back(Edit{SetIntegrator{settings.integrator}});
  if (settings.integrator->stability == Stability::Adaptive)
    requests.emplace_back(Edit{RestoreParameter{&tolerance_parameter, *settings.tolerance}, changes_method});
  else
    requests.emplace_back(Edit{RestoreParameter{&substeps_parameter, static_cast<double>(settings.substeps)}, changes_method});
}

void cost_section(const PanelInput& input, Requests& requests) {
  heading("Cost of accuracy");
  if (!input.results.advice) return paragraph("Once it has run, other settings are tested on copies of the scene...", palette::dim);
  const CostAdvice& advice = *input.results.advice;
  const Settings& present = input.status.snapshot->settings;
  advice_row(advice.half_error, present, requests);
  advice_row(advice.cheaper, present, requests);
  const bool is_same = advice.cheaper && advice.better && advice.cheaper->settings == advice.better->settings;
  if (!is_same) advice_row(advice.better, present, requests);
  if (!advice.half_error && !advice.cheaper && !advice.better) paragraph("No better setting was found.");
  explanation("Measured on copies, over frames that follow the present state and two later ones.");
}

}  // namespace

ImU32 color_of(const Judgement& judgement) {
  using enum Judgement::Level;
  return judgement.level == Bad ? palette::bad : judgement.level == Doubtful ? palette::warning : palette::dim;
}

void build_accuracy_line(const PanelInput& input, Panels& panels) {
  const Accuracy& accuracy = input.status.accuracy;
  ImGui::PushFont(fonts().small);
  begin_row("Error");
  ImGui::PushStyleColor(ImGuiCol_Text, color_of(judge(accuracy)));
  std::vector<std::string> lines = accuracy_lines(accuracy);
  for (std::string& line : lines)
    if (line.starts_with("error")) line.erase(0, line.find(' ') + 1);
  // one line, so that the rows below do not move under the mouse: what does not fit is in the tooltip
  const float width = ImGui::GetContentRegionAvail().x;
  const auto fits = [&](const std::string& line) { return ImGui::CalcTextSize(line.c_str()).x <= width; };
  const auto shown = std::find_if(lines.begin(), lines.end() - 1, fits);
  ImGui::TextUnformatted(shortened(*shown, width).c_str());
  if (ImGui::IsItemClicked()) panels.shown.accuracy = !panels.shown.accuracy;
  tooltip((shown == lines.begin() ? "" : lines.front() + "\n") + "Estimated error of the run. Click for details.");
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

void build_accuracy(const PanelInput& input, Panels& panels, Requests& requests) {
  if (!panels.shown.accuracy) return;
  DockedPanel panel("accuracy", dock_panel(input.layout, units(1.0), accuracy_panel_width, 500.0, true), panels);
  bool is_on = input.status.accuracy.is_on;
  if (ImGui::Checkbox("Measure the accuracy", &is_on))
    requests.emplace_back(Control(SetAccuracy{is_on ? AccuracyMode::Full : AccuracyMode::Off}));
  tooltip("Costs less than a tenth of a frame, and idle time");
  panel.begin_content();
  if (input.status.accuracy.is_on) {
    error_section(input.status.accuracy);
    predictability_section(input.status.accuracy);
    energy_section(input.status.accuracy);
    cost_section(input, requests);
    heading("Is this real?");
    if (ImGui::Button("Check this result")) requests.emplace_back(Action::CheckResult);
    tooltip(Action::CheckResult, "half the step, and twice the resolution of sheets and ropes");
  } else {
    paragraph("Switched off: no error is shown.", palette::dim);
  }
  panel.end_content();
  if (ImGui::Button("Compare methods", {units(144.0), units(30.0)})) requests.emplace_back(Action::CompareMethods);
  tooltip(Action::CompareMethods);
  ImGui::SameLine();
  if (ImGui::Button("Close", {units(96.0), units(30.0)})) panels.shown.accuracy = false;
}

}  // namespace hooke
