// What several panels are made of.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <string>

#include "ui/icons.h"
#include "ui/layout.h"
#include "ui/shortcuts.h"
#include "ui/theme.h"

namespace hooke {

inline constexpr ImGuiWindowFlags fixed_panel = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                                ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                                ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing;

// A box over the panels: in front of them, and of what it came after.
inline constexpr ImGuiWindowFlags front_box =
    (fixed_panel & ~(ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing)) | ImGuiWindowFlags_AlwaysAutoResize;

inline ImVec2 corner(const Rect& rect) { return {static_cast<float>(rect.x), static_cast<float>(rect.y)}; }
inline ImVec2 extent(const Rect& rect) { return {static_cast<float>(rect.width), static_cast<float>(rect.height)}; }
Rect current_window();
// So wide a box, or as the window has room for.
inline float box_width(double wished) { return std::min(units(wished), std::max(1.0f, ImGui::GetIO().DisplaySize.x - units(16.0))); }

// Where the middle of a box of that width stands over the scene, or as near as keeps it within the window.
inline float middle_for(const Rect& scene, float width) {
  const float half = 0.5f * width, middle = static_cast<float>(scene.x + 0.5 * scene.width);
  return std::clamp(middle, half, std::max(half, ImGui::GetIO().DisplaySize.x - half));
}

// Begins a panel that fills a place of the window.
bool begin_panel(const char* name, const Rect& place, ImGuiWindowFlags flags = 0);

// A flat button with a sign; `active` is tinted, as a tool in hand is.
bool icon_button(const char* id, Icon icon, ImVec2 size, bool active = false, bool enabled = true);

// The heading of a part of a panel, a line above it; a click folds the part. True: unfolded.
bool section(const std::string& title, const std::string& remark = {}, bool starts_open = true);

// What hovering the last item says.
void tooltip(const std::string& text);
// "Undo nail 3 points  (Ctrl+Z)"
void tooltip(Action action, const std::string& detail = {});

// The share of a work that is done, and the time that it will still take, by the `seconds` that it took so far.
void progress_bar(double fraction, double seconds, float width);

// Goes on in this line where an item of so much text fits.
inline void same_line_for(const char* text) {
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < ImGui::CalcTextSize(text).x + 2.0f * ImGui::GetStyle().FramePadding.x) ImGui::NewLine();
}

void text_in(ImU32 color, const std::string& text);
void dim_text(const std::string& text);

}  // namespace hooke
