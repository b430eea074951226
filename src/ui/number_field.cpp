#include "ui/number_field.h"

#include <algorithm>
#include <cmath>

#include "ui/text.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

// Format of a dragged value, and of a value edited as text. ImGui takes 10^-digits for zero on a logarithmic slider: `small_digits` is for
// one whose minimum is less than 1e-3.
constexpr const char *dragged_digits = "%.3g", *small_digits = "%.12g", *typed_digits = "%.8g";
// Where a logarithmic slider that includes zero snaps to it: ImGui's 10^-digits for the format of a drag.
constexpr double min_of_logarithm = 1e-3;

// "185 N/m"; "varies, ~185 N/m" for different values.
std::string value_text(const NumberField& field) {
  if (field.value == 0.0 && !field.mixed && !field.zero_text.empty()) return std::string(field.zero_text);
  const std::string text = field.mixed ? "varies, ~" + number_text(field.value, 3) : number_text(field.value);
  return field.unit.empty() ? text : text + " " + unit_text(field.unit);
}

// The same, without the unit where it has no room.
std::string fitted_text(const NumberField& field, float room) {
  std::string text = value_text(field);
  if (ImGui::CalcTextSize(text.c_str()).x <= room || field.unit.empty()) return text;
  text.resize(text.size() - unit_text(field.unit).size() - 1);
  return text;
}

Bounds allowed_range(const NumberField& field) { return field.typed.value_or(Bounds{.min = field.min, .max = field.max}); }

double fitted(const NumberField& field, double value) {
  if (std::isnan(value)) return field.default_value;
  if (field.step > 0.0) value = field.step * std::round(value / field.step);
  if (!std::isfinite(value) || !allowed_range(field).contains(value)) value = std::clamp(value, field.min, field.max);
  return field.integer ? std::round(value) : value;
}

// The tooltip: the description, and how to use the slider.
std::string hint_of(const NumberField& field) {
  const std::string text(field.description), drag = field.mixed ? "Drag to scale all, Ctrl+click to make them equal" : "Ctrl+click to type";
  return text + (text.empty() ? "" : "\n") + drag + "; right-click resets to " + with_unit(field.default_value, field.unit) + ".";
}

// The position of the value between min and max, as computed by the slider of ImGui.
double fraction_of(const NumberField& field) {
  const double value = std::clamp(field.value, field.min, field.max);
  if (!field.logarithmic) return (value - field.min) / (field.max - field.min);
  const double min = field.min > 0.0 ? field.min : min_of_logarithm;
  return value <= min ? 0.0 : std::log(value / min) / std::log(field.max / min);
}

double three_digits(double value) {
  if (!(value > 0.0)) return value;
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
  return unit * std::round(value / unit);
}

// The slider of ImGui handles the mouse and keyboard; draw_slider draws it.
bool invisible_slider(const NumberField& field, double& value, bool typing) {
  const bool is_typed = typing || ImGui::GetIO().KeyCtrl, is_small = field.logarithmic && field.min > 0.0 && field.min < min_of_logarithm;
  const char* format = is_typed ? typed_digits : is_small ? small_digits : dragged_digits;
  const ImGuiSliderFlags flags = field.logarithmic ? ImGuiSliderFlags_Logarithmic : 0;
  if (!field.integer) {
    const bool changed = ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &field.min, &field.max, format, flags);
    if (changed && is_small && !is_typed) value = three_digits(value);
    return changed;
  }
  int number = static_cast<int>(std::clamp(value, -2e9, 2e9));
  const bool changed = ImGui::SliderInt("##value", &number, static_cast<int>(field.min), static_cast<int>(field.max), "%d", flags);
  if (changed) value = number;
  return changed;
}

// A line at the value. Where the text is, a small triangle below it, so that nothing crosses the digits.
void draw_handle(ImDrawList& list, float x, ImVec2 min, ImVec2 max, float text_min, float text_max) {
  const float half = units(1.0), inset = units(2.0), gap = units(3.0), size = units(3.0);
  if (x < text_min - gap || x > text_max + gap)
    list.AddRectFilled({x - half, min.y + inset}, {x + half, max.y - inset}, palette::accent, half);
  else
    list.AddTriangleFilled({x, max.y - size}, {x + size, max.y}, {x - size, max.y}, palette::accent);
}

// A bar filled up to the value, with a line at the value and the value as text.
void draw_slider(const NumberField& field) {
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool highlighted = ImGui::IsItemHovered() || ImGui::IsItemActive();
  const float rounding = ImGui::GetStyle().FrameRounding;
  list.AddRectFilled(min, max, highlighted ? palette::hovered : palette::raised, rounding);
  const std::string text = fitted_text(field, max.x - min.x - units(16.0));
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at{max.x - size.x - units(8.0), 0.5f * (min.y + max.y - size.y)};
  if (field.enabled) {
    const float end = min.x + static_cast<float>(fraction_of(field)) * (max.x - min.x);
    list.PushClipRect(min, {end, max.y}, true);
    list.AddRectFilled(min, max, palette::tinted, rounding);
    list.PopClipRect();
    draw_handle(list, std::clamp(end, min.x + units(1.0), max.x - units(1.0)), min, max, at.x, at.x + size.x);
  }
  list.AddText(at, field.enabled ? palette::text : palette::dim, text.c_str());
}

// A press far from the handle waits for a drag: a slider's end is too easily hit, and far from any useful value.
bool is_stray_click(const NumberField& field, Panels& panels) {
  constexpr double near_handle = 16.0, drag = 3.0;  // [design units]
  if (ImGui::IsItemActivated()) {
    const float handle = ImGui::GetItemRectMin().x + static_cast<float>(fraction_of(field)) * ImGui::GetItemRectSize().x;
    panels.field.slider_waits = std::abs(ImGui::GetIO().MousePos.x - handle) > units(near_handle);
  }
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, units(drag))) panels.field.slider_waits = false;
  return panels.field.slider_waits && (ImGui::IsItemActive() || ImGui::IsItemDeactivated());
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

std::string bounds_text(const Bounds& range, std::string_view unit) {
  if (!std::isfinite(range.min) || !std::isfinite(range.max)) return range.text().substr(std::string_view("must be ").size());
  return "from " + number_text(range.min) + " to " + with_unit(range.max, unit);
}

void begin_row(const std::string& label) {
  constexpr double column = 136.0;  // [design units]
  ImGui::AlignTextToFramePadding();
  const bool is_long = ImGui::GetCursorPosX() + ImGui::CalcTextSize(label.c_str()).x > units(column - 4.0);
  if (is_long) ImGui::PushFont(fonts().small);
  dim_text(label);
  if (is_long) ImGui::PopFont();
  ImGui::SameLine(units(column));
}

std::optional<double> number_row(const NumberField& field, Panels& panels) {
  const auto changed = changed_row(field, panels);
  return changed ? std::optional(changed->value) : std::nullopt;
}

std::optional<NumberChange> changed_row(const NumberField& field, Panels& panels) {
  ImGui::BeginDisabled(!field.enabled);
  begin_row(std::string(field.label));
  const ImGuiID id = ImGui::GetID("##value");
  double value = field.value;
  bool changed = slider(field, value, panels.field.typing == id);
  const bool typing = ImGui::IsItemActive() && ImGui::GetIO().WantTextInput;
  if (typing)
    panels.field.typing = id;
  else if (panels.field.typing == id)
    panels.field.typing = 0;
  if (!typing) draw_slider(field);
  bool is_drag = !typing;
  if (is_stray_click(field, panels) && !typing) changed = false;

  // an unfinished number is ignored
  if (changed && typing) panels.field.typed_number = value;
  if (typing) changed = false;
  if (ImGui::IsItemDeactivatedAfterEdit() && panels.field.typed_number) {
    value = *panels.field.typed_number;
    is_drag = false;
    panels.field.typed_number.reset();
    changed = allowed_range(field).contains(value);
    if (std::isnan(value))
      panels.show_toast("Not a number; " + std::string(field.label) + " is unchanged");
    else if (!changed)
      panels.show_toast(std::string(field.label) + " must be " + bounds_text(allowed_range(field), field.unit) + "; it is unchanged");
  }

  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) {
    value = field.default_value;
    changed = true;
    is_drag = false;
  }
  if (!ImGui::IsItemActive()) tooltip(hint_of(field));
  ImGui::EndDisabled();

  value = fitted(field, value);
  return changed && (value != field.value || field.mixed) ? std::optional(NumberChange{value, is_drag}) : std::nullopt;
}

}  // namespace hooke
