// What stretches the selected springs: a table below their properties.
#include <string>

#include "ui/number_field.h"
#include "ui/panels.h"
#include "ui/text.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

std::string percent_text(double strain) { return number_text(100.0 * strain, 3) + " %"; }

void strain_row(const char* name, const std::optional<double>& strain, const char* description) {
  if (!strain) return;
  begin_row(name);
  ImGui::TextUnformatted(percent_text(*strain).c_str());
  tooltip(description);
}

void strain_rows(const StretchBreakdown& stretch) {
  ImGui::PushFont(fonts().small);
  strain_row("Load", stretch.load, "Strain in the equilibrium under the weight.");
  if (!stretch.load) {
    begin_row("Load");
    text_in(palette::dim, stretch.why_no_load);
  }
  strain_row("Solver", stretch.solver,
             "How much longer the springs are at rest because the iterations of the method end before they converge.");
  strain_row("Strain limit", stretch.limit, "How much shorter the strain limit makes the springs.");
  strain_row("Motion", stretch.motion, "The rest: motion, and what the hand, contact and other forces stretch.");
  strain_row("Together", stretch.load ? std::optional(stretch.now) : std::nullopt,
             "Mean strain of the selected springs when it was computed.");
  if (stretch.step_error) {
    begin_row("Step error");
    ImGui::TextUnformatted(("\u00b1 " + percent_text(*stretch.step_error)).c_str());
    tooltip("Difference to a run with half the step within " + quantity_text(stretch.seconds, "s", 3) + " from then; part of the motion.");
  }
  ImGui::PopFont();
}

}  // namespace

void build_stretch(const PanelInput& input, Requests& requests) {
  const ResultStatus<StretchBreakdown>& status = input.results.stretch;
  const bool is_of_selection = status.result && status.result->springs == input.selection.springs;
  begin_row("Stretch");
  if (status.is_running) {
    dim_text("computing...");
  } else {
    if (ImGui::Button(is_of_selection ? "Explain again" : "Explain")) requests.emplace_back(ExplainStretch{});
    tooltip("What the load, the solver, the strain limit and the motion contribute to the strain of the selected springs");
  }
  if (is_of_selection) strain_rows(*status.result);
}

}  // namespace hooke
