// Widgets shared by several panels.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <string>

#include "ui/icons.h"
#include "ui/layout.h"
#include "ui/plot_axis.h"
#include "ui/shortcuts.h"
#include "ui/theme.h"

namespace hooke {

inline constexpr ImGuiWindowFlags fixed_panel = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                                ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                                ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing;

// A window in front of the panels.
inline constexpr ImGuiWindowFlags front_box =
    (fixed_panel & ~(ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing)) | ImGuiWindowFlags_AlwaysAutoResize;

inline ImVec2 corner(const Rect& rect) { return {static_cast<float>(rect.x), static_cast<float>(rect.y)}; }
inline ImVec2 extent(const Rect& rect) { return {static_cast<float>(rect.width), static_cast<float>(rect.height)}; }
Rect current_window();
// The desired width [design units], limited to that of the window.
inline float box_width(double desired) { return std::min(units(desired), std::max(1.0f, ImGui::GetIO().DisplaySize.x - units(16.0))); }

// The x of the center of a dialog over the scene, shifted if necessary to keep it within the window.
inline float middle_for(const Rect& scene, float width) {
  const float half = 0.5f * width, middle = static_cast<float>(scene.x + 0.5 * scene.width);
  return std::clamp(middle, half, std::max(half, ImGui::GetIO().DisplaySize.x - half));
}

// Whether the keyboard has moved the focus to an item that is not being typed into.
bool has_focused_item();
// Presses the item that has the focus, as Space does.
void press_focused_item();

// Between them, Tab goes to buttons as well as to fields, and the focus is visible.
void begin_tab_stops();
void end_tab_stops();

// Begins a panel that fills a rectangle of the window.
bool begin_panel(const char* name, const Rect& place, ImGuiWindowFlags flags = 0);

// Begins and ends a box in front of the panels, whose place and size were set before.
void begin_front_box(const char* name, ImVec2 padding);
void end_front_box();

// A flat button with an icon; `active` tints it, as for the current tool.
bool icon_button(const char* id, Icon icon, ImVec2 size, bool active = false, bool enabled = true);

// The heading of a section of a panel; a click collapses it. Returns true if it is expanded.
bool section(const std::string& title, const std::string& remark = {}, bool starts_open = true);
// Expands or collapses it.
void open_section(const std::string& title, bool open);

// The tooltip of the last item.
void tooltip(const std::string& text);
// "Undo nail 3 points  (Ctrl+Z)"
void tooltip(Action action, const std::string& detail = {});

// At the right end of the last row of a panel. Returns whether it was pressed.
bool close_button();

// The fraction done, and an estimate of the remaining time from the `seconds` taken so far.
void progress_bar(double fraction, double seconds, float width);

// Continues on the same line if an item with this text fits.
inline void same_line_for(const char* text) {
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < ImGui::CalcTextSize(text).x + 2.0f * ImGui::GetStyle().FramePadding.x) ImGui::NewLine();
}

// Text on a ground that extends beyond it by `margin` and is rounded [design units].
void shaded_text(ImDrawList& list, ImVec2 at, const std::string& text, ImVec2 margin, double rounding = 4.0);
// Lines across a chart at powers of ten of a length [m], at most about `count` of them, with labels on its left side.
void draw_decades(ImDrawList& list, const LogAxis& axis, ImVec2 min, ImVec2 max, int count);

void text_in(ImU32 color, const std::string& text);
void dim_text(const std::string& text);
void strong_text(const std::string& text, ImU32 color = palette::text);

}  // namespace hooke
