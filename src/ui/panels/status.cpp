// The status bar: the tool and its next step; the computing time of the scene and its speed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "lab/accuracy/accuracy_text.h"
#include "ui/panels.h"
#include "ui/text.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

// The speed, or how long a frame has been computed that takes much longer than those before it.
std::string speed_text(const PanelInput& input) {
  constexpr double noticed = 0.5;  // [s]
  if (!input.status.run.running) return "paused";
  if (input.waiting_seconds > noticed) return "this frame: " + number_text(std::round(10.0 * input.waiting_seconds) / 10.0) + " s so far";
  return number_text(std::round(100.0 * input.status.run.speed) / 100.0) + "\u00d7 real time";
}

struct Figures {
  std::string error, rest;
};

// From the most detailed to the shortest. The error is the last part to be shortened.
std::vector<Figures> figures(const PanelInput& input) {
  const Status& status = input.status;
  char text[160];
  const std::string speed = speed_text(input);
  const std::string simulate = status.run.simulate_ms() > 0.0 ? "simulate " + milliseconds_text(status.run.simulate_ms()) + "    " : "";
  std::snprintf(text, sizeof text, "draw %.1f ms    %.0f frames/s    ", input.draw_ms, input.frames_per_second);
  // a picture without a window has none
  const std::string draw = input.frames_per_second > 0.0 ? text : "";
  std::vector<Figures> all;
  for (const std::string& error : accuracy_lines(status.accuracy)) {
    if (all.empty()) all = {{error + "    ", simulate + draw + speed}, {error + "    ", simulate + speed}};
    all.push_back({error + "    ", speed});
  }
  return all;
}

float width_of(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }

// What is being written to a file, shown in red.
std::string recording_text(const PanelInput& input) {
  std::string taken;
  if (input.film_seconds >= 0.0)
    taken = "\u25cf film " + number_text(std::floor(input.film_seconds)) + " s, " + key_text(shortcut_of(Action::FilmOnOff)) + " stops    ";
  if (!input.status.recording.file.empty()) taken += "\u25cf recording    ";
  if (input.status.recording.playback_progress > 0.0)
    taken += "replay " + number_text(std::round(100.0 * input.status.recording.playback_progress)) + " %    ";
  return taken;
}

// Shown while the hand cannot keep up with the cursor.
std::string hand_text(const PanelInput& input) {
  constexpr double noticed = 1e-6;  // [m]
  return input.status.run.hand_lag > noticed
             ? "hand " + quantity_text(input.status.run.hand_lag, "m") + " behind the cursor: speed limit reached"
             : "";
}

}  // namespace

void build_status_bar(const PanelInput& input) {
  const Rect& bar = input.layout.status;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(12.0), units(5.0)});
  begin_panel("status", bar, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
  ImGui::GetWindowDrawList()->AddLine(corner(bar), {static_cast<float>(bar.x + bar.width), static_cast<float>(bar.y)}, palette::line);
  ImGui::PushFont(fonts().small);
  ImGui::SetCursorPosY(units(7.0));
  const std::string tool(shortcut_of(input.tool.action).text), hand = hand_text(input), taken = recording_text(input);

  // the most detailed figures that leave space for the text, which is truncated otherwise
  const float edge = units(14.0), gap = units(16.0), line = static_cast<float>(bar.width) - 2.0f * edge;
  const float left = width_of(tool) + units(8.0),
              desired = left + width_of(input.tool.next_step) + gap + (hand.empty() ? 0.0f : width_of(hand) + gap);
  const auto all = figures(input);
  const auto text = std::ranges::find_if(all.begin(), all.end() - 1,
                                         [&](const Figures& each) { return desired + width_of(taken + each.error + each.rest) <= line; });
  const float right = width_of(taken + text->error + text->rest);

  text_in(palette::accent, tool);
  ImGui::SameLine(0.0f, units(8.0));
  ImGui::TextUnformatted(shortened(input.tool.next_step, line - left - gap - right - (hand.empty() ? 0.0f : width_of(hand) + gap)).c_str());
  if (!hand.empty()) {
    ImGui::SameLine(0.0f, gap);
    text_in(palette::warning, hand);
  }
  ImGui::SameLine();
  ImGui::SetCursorPosX(static_cast<float>(bar.width) - right - edge);
  text_in(palette::bad, taken);
  ImGui::SameLine(0.0f, 0.0f);
  // highlighted if slower than requested
  const bool slow =
      input.status.run.running && input.status.run.speed > 0.0 && input.status.run.speed < 0.9 * input.status.snapshot->settings.speed;
  text_in(color_of(judge(input.status.accuracy)), text->error);
  ImGui::SameLine(0.0f, 0.0f);
  text_in(slow ? palette::warning : palette::dim, text->rest);
  ImGui::PopFont();
  ImGui::End();
}

}  // namespace hooke
