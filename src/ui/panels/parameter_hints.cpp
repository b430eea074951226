// The effect of a parameter on the current scene: a line below its slider.
#include <cmath>

#include "scene/parameters.h"
#include "sim/methods/integrator.h"
#include "study/forecast.h"
#include "ui/number_field.h"
#include "ui/panels.h"
#include "ui/text.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

// Two digits: an estimate.
std::string sag_text(double sag) {
  if (sag < 1e-6) return "< 1 \u03bcm";
  return "~ " + (sag < 1e-3  ? number_text(1e6 * sag, 2) + " \u03bcm"
                 : sag < 1.0 ? number_text(1e3 * sag, 2) + " mm"
                             : quantity_text(sag, "m", 2));
}

// The reason where a forecast is not there yet.
constexpr const char* computing = "computing...";

// Negligible values are shown as 0.
std::string ratio_text(double ratio) { return ratio < 5e-5 ? "0" : number_text(ratio, 2); }

// A small line under a slider: a name and a value, with a colored dot if it is good or bad. It keeps its height, so that the rows below do
// not move under the mouse: what does not fit is in the tooltip.
void remark(const std::string& name, const std::string& text, const std::string& description, ImU32 dot = 0,
            ImU32 text_color = palette::dim, const std::string& short_text = {}) {
  ImGui::PushFont(fonts().small);
  begin_row(name);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (dot != 0) {
    const float radius = units(4.0), middle = at.y + ImGui::GetStyle().FramePadding.y + 0.5f * ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x + radius, middle}, radius, dot);
    ImGui::SetCursorScreenPos({at.x + units(14.0), at.y});
    ImGui::AlignTextToFramePadding();
  }
  const float width = ImGui::GetContentRegionAvail().x;
  const bool is_short = !short_text.empty() && ImGui::CalcTextSize(text.c_str()).x > width;
  const std::string shown = shortened(is_short ? short_text : text, width);
  text_in(text_color, shown);
  ImGui::PopFont();
  tooltip(shown == text ? description : text + "\n" + description);
}

// The step, or the number of substeps that is needed; and omega h with the limit of the method.
void step_remark(const Snapshot& snapshot) {
  const double h = snapshot.settings.substep(), limit = snapshot.largest_stable_step;
  const double fraction = limit > 0.0 ? h / limit : INFINITY;
  const bool anything = snapshot.omega > 0.0;
  const ImU32 text_color = !anything ? palette::dim : fraction > 1.0 ? palette::bad : fraction > 0.8 ? palette::warning : palette::good;

  std::string text = "\u03c9h = " + number_text(snapshot.omega * h, 3);
  std::string short_text, name = "step " + number_text(1000.0 * h, 3) + " ms";
  if (!anything)
    text = "\u03c9h = 0 (no oscillation)";
  else if (limit == 0.0)
    text += " (always unstable)";
  else if (std::isinf(limit))
    text += " (no limit)";
  else if (fraction > 0.8 && fraction <= 1.0) {
    const std::string percent = number_text(std::floor(100.0 * fraction)) + " %";
    short_text = text + " (" + percent + ")";
    text += ", " + percent + " of the limit";
  } else {
    const std::string value = number_text(snapshot.omega * limit, 3) + ")", contact = snapshot.is_limited_by_contact ? "contact " : "";
    short_text = text + " (" + contact + value;
    text += " (" + contact + "limit " + value;
  }
  const std::string method = snapshot.settings.integrator->short_name();
  std::string description = "Highest angular frequency of the scene times the step. The simulation can blow up beyond the limit of " +
                            method + (anything && !snapshot.step_limit.empty() ? ": " + snapshot.step_limit + "." : ".");
  if (anything && limit > 0.0 && fraction > 1.0) {
    // the substeps that are needed, and why more are recommended
    const double needed = std::ceil(1.0 / (snapshot.settings.frame_rate * limit)), with_margin = snapshot.recommended_margin * needed;
    const double recommended = snapshot.recommended_substeps;
    const std::string times = std::to_string(snapshot.recommended_margin);
    description = text + " with " + method + ": " + snapshot.step_limit + ". Use ";
    if (recommended == 0.0) {
      description += "a method that adapts its steps, because points pass the center of a force or colliders oscillate too fast.";
      short_text = "use " + std::string(adaptive_integrator().id);
    } else if (recommended > with_margin) {
      description +=
          number_text(recommended) + " substeps, which resolve how fast points pass the center of a force and colliders oscillate.";
      short_text = "use " + number_text(recommended);
    } else {
      description += number_text(recommended) + ", " + times + " times as many: a measured margin for springs that stretch and rotate far.";
      short_text = "use " + number_text(recommended) + " (" + times + "\u00d7)";
    }
    name = (snapshot.is_limited_by_contact ? "contact limit " : "linear limit ") + number_text(needed);
    text = "recommended " + short_text.substr(4);
  }
  remark(name, text, description, text_color, anything && fraction > 0.8 ? text_color : palette::dim, short_text);
}

void sag_remark(const Forecast& forecast) {
  remark("sag",
         forecast.sag                  ? sag_text(*forecast.sag)
         : forecast.why_no_sag.empty() ? computing
                                       : forecast.why_no_sag,
         "Largest displacement by gravity at rest, compared with the unloaded shape. Needs a nail (N) in every part, no colliders or other "
         "forces, and at most 1,700 points.");
}

void ratio_remark(double (*ratio)(const Forecast&, const Mode&), const std::string& of, const Forecast& forecast) {
  const auto of_mode = [&](const std::optional<Mode>& mode, const std::string& which) -> std::string {
    if (!mode) return "";
    const double value = ratio(forecast, *mode);
    return std::isnan(value) ? which + " varies" : ratio_text(value) + " " + which;
  };
  const std::string slowest = of_mode(forecast.slowest, "slowest"), fastest = of_mode(forecast.fastest, "fastest");
  std::string text = slowest.empty() ? fastest : slowest + ", " + fastest;
  if (fastest.empty()) text = forecast.system == nullptr ? computing : "no oscillation";
  if (slowest == "slowest varies" && fastest == "fastest varies") text = "varies between parts";
  if (fastest == "0 fastest" && (slowest.empty() || slowest == "0 slowest")) text = "0";
  const auto period = [](const Mode& mode) { return quantity_text(2.0 * 3.14159265358979323846 / mode.omega, "s"); };
  std::string description = "Damping ratio of the oscillations of the scene due to " + of +
                            " alone: 1 is critical damping; above it, motion decays without oscillating. ";
  if (forecast.slowest && forecast.fastest)
    description += "Longest period " + period(*forecast.slowest) + ", shortest " + period(*forecast.fastest) + ".";
  remark("damping ratio \u03b6", text, description);
}

}  // namespace

void parameter_hint_row(const Parameter& row, const PanelInput& input) {
  using Scope = Parameter::Scope;
  if (&row == &substeps_parameter) return step_remark(*input.status.snapshot);
  if (input.results.forecast == nullptr || input.status.snapshot->system->springs().empty()) return;
  const bool is_per_family = row.springs.family.has_value();
  if ((row.scope == Scope::SpringStiffness && !is_per_family) || row.scope == Scope::PointMass || row.scope == Scope::Gravity)
    sag_remark(*input.results.forecast);
  else if (row.scope == Scope::SpringDamping)
    ratio_remark([](const Forecast&, const Mode& mode) { return dashpot_ratio(mode); }, "dashpots", *input.results.forecast);
  else if (&row == &drag_parameter)
    ratio_remark([](const Forecast& forecast, const Mode& mode) { return drag_ratio(mode, forecast.drag); }, "drag",
                 *input.results.forecast);
}

}  // namespace hooke
