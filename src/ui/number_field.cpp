#include "ui/number_field.h"

#include <algorithm>
#include <cmath>

#include "ui/text.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

// Digits that a drag sets, and that a typed number starts with.
constexpr const char *dragged_digits = "%.3g", *typed_digits = "%.8g";
// Below this a logarithmic slider that reaches zero is at zero: ImGui's 10^-digits for the format of a drag.
constexpr double least_of_logarithm = 1e-3;

// "m/s^2" as it is written by hand.
std::string pretty(std::string_view unit) {
  std::string text(unit);
  if (const auto at = text.find("^2"); at != std::string::npos) text.replace(at, 2, "\u00b2");
  return text;
}

std::string value_text(const NumberField& field) {
  char mean[32];
  std::snprintf(mean, sizeof mean, "~ %.3g", field.value);
  const bool is_long = std::abs(field.value) >= 1000.0 && std::abs(field.value) < 1e7;
  const std::string whole = std::to_string(std::lround(std::clamp(field.value, -1e7, 1e7)));
  std::string text = is_long ? (field.mixed ? "~ " : "") + whole : field.mixed ? mean : number(field.value);
  if (!field.unit.empty()) text.append(" ").append(pretty(field.unit));
  return text;
}

double fitted(const NumberField& field, double value) {
  if (std::isnan(value)) return field.usual;
  if (field.step > 0.0) value = field.step * std::round(value / field.step);
  value = std::clamp(value, field.least, field.most);
  return field.whole ? std::round(value) : value;
}

// What it is, and what a hand can do with it.
std::string hint_of(const NumberField& field) {
  std::string text(field.meaning);
  if (field.mixed) text += " They differ: this is their mean, and setting it makes them equal.";
  const std::string unit = field.unit.empty() ? "" : " " + pretty(field.unit);
  return text + (text.empty() ? "" : "\n") + "Ctrl+click types it, a right click gives " + number(field.usual) + unit + ".";
}

// Where the value stands between least and most, as ImGui's slider has it.
double share_of(const NumberField& field) {
  const double value = std::clamp(field.value, field.least, field.most);
  if (!field.logarithmic) return (value - field.least) / (field.most - field.least);
  const double least = std::max(field.least, least_of_logarithm);
  return value <= least ? 0.0 : std::log(value / least) / std::log(field.most / least);
}

// ImGui's slider without its looks: what is under the mouse, and what is typed.
bool invisible_slider(const NumberField& field, double& value, bool typing) {
  const char* format = typing || ImGui::GetIO().KeyCtrl ? typed_digits : dragged_digits;
  const ImGuiSliderFlags flags = field.logarithmic ? ImGuiSliderFlags_Logarithmic : 0;
  if (!field.whole) return ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &field.least, &field.most, format, flags);
  int number = static_cast<int>(std::clamp(value, -2e9, 2e9));
  const bool changed = ImGui::SliderInt("##value", &number, static_cast<int>(field.least), static_cast<int>(field.most), "%d", flags);
  if (changed) value = number;
  return changed;
}

// A line where the value is: only its ends where the words are.
void draw_mark(ImDrawList& list, float x, ImVec2 least, ImVec2 most, bool under_words) {
  const float half = units(1.0), top = least.y + units(2.0), bottom = most.y - units(2.0), end = units(3.0);
  if (!under_words) return list.AddRectFilled({x - half, top}, {x + half, bottom}, palette::accent, half);
  list.AddRectFilled({x - half, least.y}, {x + half, least.y + end}, palette::accent);
  list.AddRectFilled({x - half, most.y - end}, {x + half, most.y}, palette::accent);
}

// A bar that is filled up to the value, the value on it.
void draw_slider(const NumberField& field) {
  const ImVec2 least = ImGui::GetItemRectMin(), most = ImGui::GetItemRectMax();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
  const float rounding = ImGui::GetStyle().FrameRounding;
  list.AddRectFilled(least, most, lit ? palette::hovered : palette::raised, rounding);
  const std::string text = value_text(field);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at{most.x - size.x - units(8.0), 0.5f * (least.y + most.y - size.y)};
  if (field.enabled) {
    const float end = least.x + static_cast<float>(share_of(field)) * (most.x - least.x);
    list.PushClipRect(least, {end, most.y}, true);
    list.AddRectFilled(least, most, palette::tinted, rounding);
    list.PopClipRect();
    const float edge = std::clamp(end, least.x + units(1.0), most.x - units(1.0));
    draw_mark(list, edge, least, most, edge > at.x - units(3.0) && edge < at.x + size.x + units(3.0));
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

  // half of a typed number is not meant
  if (changed && typing) panels.typed_number = value;
  if (typing) changed = false;
  if (ImGui::IsItemDeactivatedAfterEdit() && panels.typed_number) {
    value = *panels.typed_number;
    panels.typed_number.reset();
    changed = !std::isnan(value);
    if (!changed)
      panels.say("That is no number: " + std::string(field.label) + " stays as it was");
    else if (value < field.least || value > field.most)
      panels.say(std::string(field.label) + " goes from " + number(field.least) + " to " + number(field.most) + " " + pretty(field.unit));
  }

  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) {
    value = field.usual;
    changed = true;
  }
  if (!ImGui::IsItemActive()) tooltip(hint_of(field));
  ImGui::EndDisabled();

  value = fitted(field, value);
  return changed && (value != field.value || field.mixed) ? std::optional(value) : std::nullopt;
}

}  // namespace hooke
