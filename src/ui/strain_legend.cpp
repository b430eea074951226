#include "ui/strain_legend.h"

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
  return (strain > 0.0 ? "+" : "") + number(100.0 * strain) + " %";
}

}  // namespace

bool shows_strain_colors(const PanelInput& input, const Panels& panels) {
  const System& system = *input.status.snapshot->system;
  const bool is_colored = panels.view.springs || (panels.view.surface && !system.faces.empty());
  return panels.view.strain_colors && is_colored && !system.springs().empty();
}

void draw_strain_legend(const Snapshot& snapshot, ImVec2 at, float width, ImDrawList& list) {
  const float bar = at.y + units(20.0), height = units(8.0);
  constexpr int bands = 32;
  for (int i = 0; i < bands; ++i) {
    const float from = at.x + width * static_cast<float>(i) / bands, to = at.x + width * static_cast<float>(i + 1) / bands;
    const ImU32 less = strain_rgba(2.0 * i / bands - 1.0), more = strain_rgba(2.0 * (i + 1) / bands - 1.0);
    list.AddRectFilledMultiColor({from, bar}, {to, bar + height}, less, more, more, less);
  }

  const double scale = View::strain_scale(snapshot);
  ImGui::PushFont(fonts().small);
  const auto label = [&](float x, float align, float y, const std::string& text, ImU32 text_color) {
    list.AddText({x - align * ImGui::CalcTextSize(text.c_str()).x, y}, text_color, text.c_str());
  };
  const float below = bar + height + units(4.0);
  label(at.x, 0.0f, at.y, "Strain", palette::text);
  label(at.x + width, 1.0f, at.y, percent(snapshot.min_strain) + " to " + percent(snapshot.max_strain), palette::dim);
  label(at.x, 0.0f, below, percent(-scale), palette::dim);
  label(at.x + 0.5f * width, 0.5f, below, "0", palette::dim);
  label(at.x + width, 1.0f, below, percent(scale), palette::dim);
  ImGui::PopFont();
}

}  // namespace hooke
