#include "ui/strain_legend.h"

#include <algorithm>
#include <cmath>

#include "ui/text.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

ImU32 strain_rgba(double relative) { return to_imgui(View::strain_color(relative)); }

// A strain in percent: "+2 %". Round-off is no strain.
std::string percent(double strain) {
  constexpr double round_off = 1e-9;
  if (std::abs(strain) < round_off) return "0 %";
  return (strain > 0.0 ? "+" : "") + number_text(100.0 * strain) + " %";
}

void draw_colors(ImVec2 at, float width, float height, ImDrawList& list) {
  constexpr int bands = 32;
  for (int i = 0; i < bands; ++i) {
    const float from = at.x + width * static_cast<float>(i) / bands, to = at.x + width * static_cast<float>(i + 1) / bands;
    const ImU32 less = strain_rgba(2.0 * i / bands - 1.0), more = strain_rgba(2.0 * (i + 1) / bands - 1.0);
    list.AddRectFilledMultiColor({from, at.y}, {to, at.y + height}, less, more, more, less);
  }
}

std::string range_text(const Snapshot& snapshot) { return percent(snapshot.min_strain) + " to " + percent(snapshot.max_strain); }

}  // namespace

bool shows_strain_colors(const System& system, const ViewOptions& view) {
  const bool is_colored = view.springs || (view.surface && !system.faces.empty());
  return view.strain_colors && is_colored && !system.springs().empty();
}

void draw_strain_legend(const Snapshot& snapshot, ImVec2 at, float width, ImDrawList& list) {
  const float bar = at.y + units(20.0), height = units(8.0);
  draw_colors({at.x, bar}, width, height, list);

  const double scale = View::strain_scale(snapshot);
  ImGui::PushFont(fonts().small);
  const auto label = [&](float x, float align, float y, const std::string& text, ImU32 text_color) {
    list.AddText({x - align * ImGui::CalcTextSize(text.c_str()).x, y}, text_color, text.c_str());
  };
  const float below = bar + height + units(4.0);
  label(at.x, 0.0f, at.y, "Strain", palette::text);
  label(at.x + width, 1.0f, at.y, range_text(snapshot), palette::dim);
  label(at.x, 0.0f, below, percent(-scale), palette::dim);
  label(at.x + 0.5f * width, 0.5f, below, "0", palette::dim);
  label(at.x + width, 1.0f, below, percent(scale), palette::dim);
  ImGui::PopFont();
}

void draw_strain_legend(const Snapshot& snapshot, const Rect& strip, ImDrawList& list) {
  ImGui::PushFont(fonts().small);
  const float edge = units(14.0), gap = units(8.0), height = units(8.0), middle = static_cast<float>(strip.y + 0.5 * strip.height);
  const float end = static_cast<float>(strip.x + strip.width) - edge;
  float x = static_cast<float>(strip.x) + edge;
  const auto place_text = [&](const std::string& text, ImU32 color) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    if (x + size.x <= end) list.AddText({x, middle - 0.5f * size.y}, color, text.c_str());
    x += size.x + gap;
  };
  const double scale = View::strain_scale(snapshot);
  const std::string max = percent(scale);
  place_text("Strain", palette::text);
  place_text(percent(-scale), palette::dim);
  const float width = std::min(units(180.0), end - x - gap - ImGui::CalcTextSize(max.c_str()).x);
  if (width > 0.0f) draw_colors({x, middle - 0.5f * height}, width, height, list);
  x += width + gap;
  place_text(max, palette::dim);
  x += gap;
  place_text("now " + range_text(snapshot), palette::dim);
  ImGui::PopFont();
}

}  // namespace hooke
