#include "ui/typed_field.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/printable.h"
#include "ui/number_field.h"
#include "ui/text.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

std::string shown(const TypedField& field) {
  if (field.mixed) return {};
  if (std::isinf(field.value) && !field.infinity_text.empty()) return std::string(field.infinity_text);
  return typed_text(field.value);
}

// Of different values: "varies, ~185", or "varies" where that has no room.
std::string hint_of(const TypedField& field, float room) {
  if (!field.mixed) return {};
  const std::string text = "varies, ~" + number_text(field.value, 3);
  return std::isfinite(field.value) && ImGui::CalcTextSize(text.c_str()).x <= room ? text : "varies";
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string_view::npos ? std::string_view() : text.substr(first, last - first + 1);
}

// Parses the typed text; reports invalid input.
std::optional<double> taken(const TypedField& field, const std::string& text, Panels& panels) {
  if (trimmed(text).empty()) return std::nullopt;
  const auto number = number_typed(text, field.infinity_text);
  if (!number) {
    panels.show_toast("\"" + printable(text, 30) + "\" is not a number; " + std::string(field.label) + " is unchanged");
    return std::nullopt;
  }
  if (std::isinf(*number) && !field.infinity_text.empty()) return number;
  const Bounds range{.min = field.min, .max = field.max};
  if (range.contains(*number)) return number;
  panels.show_toast(std::string(field.label) + " must be " + bounds_text(range, field.unit) + "; it is unchanged");
  return std::nullopt;
}

}  // namespace

std::optional<double> number_typed(std::string_view text, std::string_view infinity_text) {
  text = trimmed(text);
  if (!infinity_text.empty() && text == infinity_text) return INFINITY;
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  // beyond the range of double: refused like any value out of range
  if (error == std::errc::result_out_of_range)
    return text.find("e-") != text.npos || text.find("E-") != text.npos ? 0.0 : text.starts_with('-') ? -INFINITY : INFINITY;
  if (error != std::errc() || end != text.data() + text.size() || std::isnan(value)) return std::nullopt;
  return value;
}

std::optional<double> typed_row(const TypedField& field, Panels& panels) {
  begin_row(std::string(field.label));
  const float unit_width =
      field.unit.empty() ? 0.0f : ImGui::CalcTextSize(field.unit.data(), field.unit.data() + field.unit.size()).x + units(10.0);
  const auto value = typed_cell(field, ImGui::GetContentRegionAvail().x - unit_width, panels);
  if (unit_width > 0.0f) {
    ImGui::SameLine(0.0f, units(6.0));
    dim_text(std::string(field.unit));
  }
  return value;
}

std::optional<double> typed_cell(const TypedField& field, float width, Panels& panels) {
  const ImGuiID id = ImGui::GetID("##typed");
  const float room = width - 2.0f * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(width);
  std::string text = panels.field.typing == id ? panels.field.typed_text : shown(field);
  const bool edited = ImGui::InputTextWithHint("##typed", hint_of(field, room).c_str(), &text, ImGuiInputTextFlags_AutoSelectAll);
  if (ImGui::IsItemActive() || edited) {
    panels.field.typing = id;
    panels.field.typed_text = text;
  }
  const bool finished = ImGui::IsItemDeactivatedAfterEdit();
  if (!ImGui::IsItemActive()) {
    if (panels.field.typing == id) panels.field.typing = 0;
    if (!field.description.empty()) tooltip(std::string(field.description));
  }
  if (!finished) return std::nullopt;
  const auto value = taken(field, text, panels);
  return value && (field.mixed || *value != field.value) ? value : std::nullopt;
}

bool text_field(std::string& text, float lines, Panels& panels) {
  const ImGuiID id = ImGui::GetID("##text");
  if (panels.field.typing == id) text = panels.field.typed_text;
  follow_text(text);
  const float height = std::max(1.0f, lines) * ImGui::GetTextLineHeight() + units(8.0);
  ImGui::SetNextItemWidth(-1.0f);
  bool edited = false;
  if (const RareCharacters kept(text); true)
    edited = lines > 0.0f ? ImGui::InputTextMultiline("##text", &text, {-1.0f, height}) : ImGui::InputText("##text", &text);
  const bool finished = ImGui::IsItemDeactivatedAfterEdit();
  if (ImGui::IsItemActive() || edited) {
    panels.field.typing = id;
    panels.field.typed_text = text;
  } else if (panels.field.typing == id) {
    panels.field.typing = 0;
  }
  return finished;
}

}  // namespace hooke
