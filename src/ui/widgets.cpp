#include "ui/widgets.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "lab/accuracy/accuracy_text.h"
#include "ui/wrapped_text.h"

namespace hooke {

Rect current_window() {
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  return {at.x, at.y, size.x, size.y};
}

bool has_focused_item() {
  const ImGuiContext& gui = *ImGui::GetCurrentContext();
  return gui.NavId != 0 && !gui.NavDisableHighlight && gui.ActiveId == 0;
}

void press_focused_item() {
  ImGuiContext& gui = *ImGui::GetCurrentContext();
  gui.NavActivateId = gui.NavActivateDownId = gui.NavActivatePressedId = gui.NavId;
}

// Tab goes to items with this flag; activated as inputs, buttons are not pressed. Dear ImGui 1.86 goes on from text fields only, and from
// a button to the first item again.
void begin_tab_stops() {
  if (ImGuiContext& gui = *ImGui::GetCurrentContext(); ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Tab))) {
    if (gui.NavTabbingDir == 0 && has_focused_item()) gui.NavTabbingDir = 1;
    gui.NavDisableHighlight = false;
  }
  ImGui::PushItemFlag(ImGuiItemFlags_Inputable, true);
}
void end_tab_stops() { ImGui::PopItemFlag(); }

void begin_front_box(const char* name, ImVec2 padding) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, units(8.0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, palette::box);
  ImGui::Begin(name, nullptr, front_box);
}

void end_front_box() {
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
}

bool begin_panel(const char* name, const Rect& place, ImGuiWindowFlags flags) {
  ImGui::SetNextWindowPos(corner(place));
  ImGui::SetNextWindowSize(extent(place));
  return ImGui::Begin(name, nullptr, fixed_panel | flags);
}

bool icon_button(const char* id, Icon icon, ImVec2 size, bool active, bool enabled) {
  ImGui::BeginDisabled(!enabled);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool clicked = ImGui::InvisibleButton(id, size);
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 back = active ? palette::tinted : ImGui::IsItemActive() ? palette::pressed : hovered ? palette::hovered : 0;
  if (back != 0) list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, back, units(5.0));
  const ImU32 text_color = !enabled ? palette::pressed : active ? palette::accent : palette::text;
  draw_icon(list, icon, {at.x + 0.5f * size.x, at.y + 0.5f * size.y}, units(15.0), text_color);
  ImGui::EndDisabled();
  return clicked && enabled;
}

void open_section(const std::string& title, bool open) { ImGui::GetStateStorage()->SetBool(ImGui::GetID(title.c_str()), open); }

bool section(const std::string& title, const std::string& remark, bool starts_open) {
  bool& open = *ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID(title.c_str()), starts_open);
  ImGui::Dummy({0.0f, units(1.0)});
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size{ImGui::GetContentRegionAvail().x, units(26.0)};
  if (ImGui::InvisibleButton(title.c_str(), size)) open = !open;
  const ImU32 text_color = ImGui::IsItemHovered() ? palette::text : palette::dim;

  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddLine(at, {at.x + size.x, at.y}, palette::line);
  const float middle = at.y + 0.55f * size.y, u = units(3.5);
  const ImVec2 tip = open ? ImVec2{at.x + u, middle + 0.5f * u} : ImVec2{at.x + 1.5f * u, middle};
  const ImVec2 ends[] = {{tip.x - u, tip.y - u}, tip, open ? ImVec2{tip.x + u, tip.y - u} : ImVec2{tip.x - u, tip.y + u}};
  list.AddPolyline(ends, 3, text_color, 0, units(1.5));
  ImGui::PushFont(fonts().strong);
  const float title_end = units(16.0) + ImGui::CalcTextSize(title.c_str()).x;
  list.AddText({at.x + units(16.0), middle - 0.5f * ImGui::GetFontSize()}, palette::text, title.c_str());
  ImGui::PopFont();
  ImGui::PushFont(fonts().small);
  const ImVec2 width = ImGui::CalcTextSize(remark.c_str());
  if (title_end + units(8.0) + width.x < size.x)
    list.AddText({at.x + size.x - width.x - units(2.0), middle - 0.5f * width.y}, palette::dim, remark.c_str());
  ImGui::PopFont();
  return open;
}

void tooltip(const std::string& text) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(8.0), units(6.0)});
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(wrapped(text, units(280.0)).c_str());
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

void tooltip(Action action, const std::string& detail) {
  const Shortcut& row = shortcut_of(action);
  tooltip(std::string(row.text) + (detail.empty() ? "" : ": " + detail) + "   " + key_text(row));
}

void progress_bar(double fraction, double seconds, float width) {
  // no estimate during the first moments
  char text[48] = "";
  const double left = fraction > 0.0 ? seconds * (1.0 - fraction) / fraction : 0.0;
  if (fraction > 0.03 && seconds > 0.3)
    std::snprintf(text, sizeof text, "%.0f %%, %.0f s left", 100.0 * fraction, std::ceil(left));
  else if (fraction > 0.0)
    std::snprintf(text, sizeof text, "%.0f %%", 100.0 * fraction);
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, palette::tinted);
  ImGui::ProgressBar(static_cast<float>(fraction), {width, units(30.0)}, text);
  ImGui::PopStyleColor();
}

bool close_button() {
  const ImVec2 size{units(64.0), units(30.0)};
  ImGui::SameLine(ImGui::GetWindowWidth() - size.x - ImGui::GetStyle().WindowPadding.x);
  return ImGui::Button("Close", size);
}

void shaded_text(ImDrawList& list, ImVec2 at, const std::string& text, ImVec2 margin, double rounding) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float dx = units(margin.x), dy = units(margin.y);
  list.AddRectFilled({at.x - dx, at.y - dy}, {at.x + size.x + dx, at.y + size.y + dy}, palette::shade, units(rounding));
  list.AddText(at, palette::text, text.c_str());
}

void draw_decades(ImDrawList& list, const LogAxis& axis, ImVec2 min, ImVec2 max, int count) {
  for (int decade = axis.min; decade <= axis.max; decade += std::max(1, (axis.max - axis.min) / count)) {
    const double length = std::pow(10.0, decade);
    const float y = max.y - (max.y - min.y) * axis.fraction(length);
    list.AddLine({min.x, y}, {max.x, y}, palette::line);
    const std::string label = length_text(length * (1.0 + 1e-9));
    const ImVec2 size = ImGui::CalcTextSize(label.c_str());
    list.AddText({min.x - size.x - units(6.0), y - 0.5f * size.y}, palette::dim, label.c_str());
  }
}

void text_in(ImU32 color, const std::string& text) {
  follow_text(text);
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

void dim_text(const std::string& text) { text_in(palette::dim, text); }

void strong_text(const std::string& text, ImU32 color) {
  ImGui::PushFont(fonts().strong);
  text_in(color, text);
  ImGui::PopFont();
}

}  // namespace hooke
