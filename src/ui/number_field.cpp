#include "ui/number_field.h"

#include <algorithm>
#include <cmath>

#include "ui/text.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

// "m/s^2" as it is written by hand.
std::string pretty(std::string_view unit) {
  std::string text(unit);
  if (const auto at = text.find("^2"); at != std::string::npos) text.replace(at, 2, "\u00b2");
  return text;
}

// Four digits, and no powers of ten where there is room for the zeros.
std::string format_of(const NumberField& field) {
  const std::string digits = field.whole ? "%d" : std::abs(field.value) >= 1000.0 ? "%.0f" : "%.4g";
  std::string format = field.mixed ? "~ " : "";
  format += digits;
  if (!field.unit.empty()) format.append(" ").append(pretty(field.unit));
  return format;
}

double fitted(const NumberField& field, double value) {
  if (std::isnan(value)) return field.usual;
  if (field.step > 0.0) value = field.step * std::round(value / field.step);
  value = std::clamp(value, field.least, field.most);
  return field.whole ? std::round(value) : value;
}

bool slider(const NumberField& field, double& value) {
  const std::string format = format_of(field);
  const ImGuiSliderFlags flags = field.logarithmic ? ImGuiSliderFlags_Logarithmic : 0;
  ImGui::SetNextItemWidth(-1.0f);
  if (!field.whole) return ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &field.least, &field.most, format.c_str(), flags);
  const int least = static_cast<int>(field.least), most = static_cast<int>(field.most);
  int number = static_cast<int>(std::clamp(value, -2e9, 2e9));
  const bool changed = ImGui::SliderInt("##value", &number, least, most, format.c_str(), flags);
  if (changed) value = number;
  return changed;
}

}  // namespace

void begin_row(const std::string& label) {
  ImGui::AlignTextToFramePadding();
  dim_text(label);
  ImGui::SameLine(units(124.0));
}

std::optional<double> number_row(const NumberField& field, Panels& panels) {
  ImGui::BeginDisabled(!field.enabled);
  begin_row(std::string(field.label));
  double value = field.value;
  bool changed = slider(field, value);
  const bool typing = ImGui::IsItemActive() && ImGui::GetIO().WantTextInput;

  // half of a typed number is not meant
  if (changed && typing) panels.typed_number = value;
  if (typing) changed = false;
  if (ImGui::IsItemDeactivatedAfterEdit() && panels.typed_number) {
    value = *panels.typed_number;
    panels.typed_number.reset();
    changed = true;
    if (value < field.least || value > field.most)
      panels.say(std::string(field.label) + " goes from " + number(field.least) + " to " + number(field.most) + " " + pretty(field.unit));
  }

  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) {
    value = field.usual;
    changed = true;
  }
  if (!ImGui::IsItemActive())
    tooltip(std::string(field.meaning) + (field.mixed ? " They differ: this is their mean, and setting it makes them equal." : ""));
  ImGui::EndDisabled();

  value = fitted(field, value);
  return changed && (value != field.value || field.mixed) ? std::optional(value) : std::nullopt;
}

}  // namespace hooke
