// The bar at the bottom: the tool and its next step; what the scene costs and how fast it runs.
#include <cmath>
#include <cstdio>

#include "ui/panels.h"
#include "ui/text.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

std::string figures(const Desk& desk) {
  const Status& status = desk.status;
  char text[160];
  const std::string speed = !status.running ? "paused" : number(std::round(100.0 * status.speed) / 100.0) + "\u00d7 real time";
  std::snprintf(text, sizeof text, "simulate %.*f ms    ", status.simulate_ms < 1.0 ? 2 : 1, status.simulate_ms);
  std::string line = text;
  // a picture that nobody looked at has none
  if (desk.frames_per_second > 0.0) {
    std::snprintf(text, sizeof text, "draw %.1f ms    %.0f frames/s    ", desk.draw_ms, desk.frames_per_second);
    line += text;
  }
  return line + speed;
}

}  // namespace

void build_status_bar(const Desk& desk) {
  const Rect& bar = desk.layout.status;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(12.0), units(5.0)});
  begin_panel("status", bar, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
  ImGui::GetWindowDrawList()->AddLine(corner(bar), {static_cast<float>(bar.x + bar.width), static_cast<float>(bar.y)}, palette::line);
  ImGui::PushFont(fonts().small);
  ImGui::SetCursorPosY(units(7.0));
  text_in(palette::accent, std::string(shortcut_of(desk.tool).text));
  ImGui::SameLine(0.0f, units(8.0));
  ImGui::TextUnformatted(desk.next_step.c_str());

  // the hand's top speed acts
  constexpr double noticed = 1e-6;  // [m]
  if (desk.status.hand_lag > noticed) {
    ImGui::SameLine(0.0f, units(16.0));
    text_in(palette::warning, "hand " + number(desk.status.hand_lag) + " m behind, at its top speed");
  }

  // what goes to a file all the while is said in red
  std::string taken;
  if (desk.film_seconds >= 0.0) taken = "\u25cf film " + number(std::floor(desk.film_seconds)) + " s    ";
  if (!desk.status.recording.empty()) taken += "\u25cf recording    ";
  if (desk.status.playing > 0.0) taken += "playing " + number(std::round(100.0 * desk.status.playing)) + " %    ";

  const std::string text = figures(desk);
  ImGui::SameLine();
  ImGui::SetCursorPosX(static_cast<float>(bar.width) - ImGui::CalcTextSize((taken + text).c_str()).x - units(14.0));
  text_in(palette::bad, taken);
  ImGui::SameLine(0.0f, 0.0f);
  // slower than the scene asks for: said openly
  const bool slow = desk.status.running && desk.status.speed > 0.0 && desk.status.speed < 0.9 * desk.status.snapshot->settings.speed;
  text_in(slow ? palette::warning : palette::dim, text);
  ImGui::PopFont();
  ImGui::End();
}

}  // namespace hooke
