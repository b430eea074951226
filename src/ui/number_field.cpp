#include "ui/number_field.h"

#include <algorithm>
#include <cmath>

#include "ui/text.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

// Format of a dragged value, and of a value edited as text.
constexpr const char *dragged_digits = "%.3g", *typed_digits = "%.8g";
// Where a logarithmic slider that includes zero snaps to it: ImGui's 10^-digits for the format of a drag.
constexpr double min_of_logarithm = 1e-3;

// "m/s^2" with a superscript.
std::string pretty(std::string_view unit) {
  std::string text(unit);
  if (const auto at = text.find("^2"); at != std::string::npos) text.replace(at, 2, "\u00b2");
  return text;
}

std::string value_text(const NumberField& field) {
  char mean[32];
  std::snprintf(mean, sizeof mean, "~ %.3g", field.value);
  const bool is_long = std::abs(field.value) >= 1000.0 && std::abs(field.value) < 1e7;
  const std::string integer = std::to_string(std::lround(std::clamp(field.value, -1e7, 1e7)));
  std::string text = is_long ? (field.mixed ? "~ " : "") + integer : field.mixed ? mean : number(field.value);
  if (!field.unit.empty()) text.append(" ").append(pretty(field.unit));
  return text;
}

double fitted(const NumberField& field, double value) {
  if (std::isnan(value)) return field.default_value;
  if (field.step > 0.0) value = field.step * std::round(value / field.step);
  value = std::clamp(value, field.min, field.max);
  return field.integer ? std::round(value) : value;
}

// The tooltip: the description, and how to use the slider.
std::string hint_of(const NumberField& field) {
  std::string text(field.description);
  if (field.mixed) text += " Varies between parts: this is the mean, and setting it makes all equal.";
  const std::string unit = field.unit.empty() ? "" : " " + pretty(field.unit);
  return text + (text.empty() ? "" : "\n") + "Ctrl+click to type; right-click resets to " + number(field.default_value) + unit + ".";
}

// The position of the value between min and max, as computed by the slider of ImGui.
double fraction_of(const NumberField& field) {
  const double value = std::clamp(field.value, field.min, field.max);
  if (!field.logarithmic) return (value - field.min) / (field.max - field.min);
  const double min = std::max(field.min, min_of_logarithm);
  return value <= min ? 0.0 : std::log(value / min) / std::log(field.max / min);
}

// The slider of ImGui handles the mouse and keyboard; draw_slider draws it.
bool invisible_slider(const NumberField& field, double& value, bool typing) {
  const char* format = typing || ImGui::GetIO().KeyCtrl ? typed_digits : dragged_digits;
  const ImGuiSliderFlags flags = field.logarithmic ? ImGuiSliderFlags_Logarithmic : 0;
  if (!field.integer) return ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &field.min, &field.max, format, flags);
  int number = static_cast<int>(std::clamp(value, -2e9, 2e9));
  const bool changed = ImGui::SliderInt("##value", &number, static_cast<int>(field.min), static_cast<int>(field.max), "%d", flags);
  if (changed) value = number;
  return changed;
}

// A line at the value; only its ends where it would cross the text.
void draw_mark(ImDrawList& list, float x, ImVec2 min, ImVec2 max, bool below_text) {
  const float half = units(1.0), top = min.y + units(2.0), bottom = max.y - units(2.0), end = units(3.0);
  if (!below_text) return list.AddRectFilled({x - half, top}, {x + half, bottom}, palette::accent, half);
  list.AddRectFilled({x - half, min.y}, {x + half, min.y + end}, palette::accent);
  list.AddRectFilled({x - half, max.y - end}, {x + half, max.y}, palette::accent);
}

// A bar filled up to the value, with the value as text.
void draw_slider(const NumberField& field) {
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool highlighted = ImGui::IsItemHovered() || ImGui::IsItemActive();
  const float rounding = ImGui::GetStyle().FrameRounding;
  list.AddRectFilled(min, max, highlighted ? palette::hovered : palette::raised, rounding);
  const std::string text = value_text(field);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at{max.x - size.x - units(8.0), 0.5f * (min.y + max.y - size.y)};
  if (field.enabled) {
    const float end = min.x + static_cast<float>(fraction_of(field)) * (max.x - min.x);
    list.PushClipRect(min, {end, max.y}, true);
    list.AddRectFilled(min, max, palette::tinted, rounding);
    list.PopClipRect();
    const float edge = std::clamp(end, min.x + units(1.0), max.x - units(1.0));
    draw_mark(list, edge, min, max, edge > at.x - units(3.0) && edge < at.x + size.x + units(3.0));
  }
  list.AddText(at, field.enabled ? palette::text : palette::dim, text.c_str());
}

bool slider(const NumberField& field, double& value, bool typing) {
  constexpr ImU32 nothing = IM_COL32(0, 0, 0, 0);
  ImGui::SetNextItemWidth(-1.0f);
  for (const ImGuiCol part : {ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive}) ImGui::PushStyleColor(part, nothing);
  ImGui::PushStyleColor(ImGuiCol_Text, typing ? palette::text : nothing);
  ImGui::PushStyleVar(ImGuiStyleVar_GrabMinSize, units(2.0));
  const bool changed = invisible_slider(field, value, typing);
  ImGui::PopStyleVar();
  ImGui::PopStyleColor(3);
  return changed;
}

}  // namespace

void begin_row(const std::string& label) {
  ImGui::AlignTextToFramePadding();
  dim_text(label);
  ImGui::SameLine(units(136.0));
}

std::optional<double> number_row(const NumberField& field, Panels& panels) {
  ImGui::BeginDisabled(!field.enabled);
  begin_row(std::string(field.label));
  const ImGuiID id = ImGui::GetID("##value");
  double value = field.value;
  bool changed = slider(field, value, panels.typing == id);
  const bool typing = ImGui::IsItemActive() && ImGui::GetIO().WantTextInput;
  if (typing)
    panels.typing = id;
  else if (panels.typing == id)
    panels.typing = 0;
  if (!typing) draw_slider(field);

  // an unfinished number is ignored
  if (changed && typing) panels.typed_number = value;
  if (typing) changed = false;
  if (ImGui::IsItemDeactivatedAfterEdit() && panels.typed_number) {
    value = *panels.typed_number;
    panels.typed_number.reset();
    changed = !std::isnan(value);
    if (!changed)
      panels.show_toast("Not a number; " + std::string(field.label) + " is unchanged");
    else if (value < field.min || value > field.max)
      panels.show_toast(std::string(field.label) + " must be between " + number(field.min) + " and " + number(field.max) + " " +
                        pretty(field.unit));
  }

  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) {
    value = field.default_value;
    changed = true;
  }
  if (!ImGui::IsItemActive()) tooltip(hint_of(field));
  ImGui::EndDisabled();

  value = fitted(field, value);
  return changed && (value != field.value || field.mixed) ? std::optional(value) : std::nullopt;
}

}  // namespace hooke
