// The strip below the scene: step back, the scrubber over the recorded frames, and a run to a given time.
#include <algorithm>
#include <cmath>

#include "ui/panels.h"
#include "ui/text.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

std::string seconds(double time) {
  char text[48];
  std::snprintf(text, sizeof text, "%.2f s", time);
  return text;
}

struct Track {
  ImVec2 at, size;
  double first, last;  // [s]
  float x_of(double time) const {
    const double fraction = last > first ? std::clamp((time - first) / (last - first), 0.0, 1.0) : 1.0;
    return at.x + static_cast<float>(fraction) * size.x;
  }
  double time_at(float x) const { return first + std::clamp(static_cast<double>((x - at.x) / size.x), 0.0, 1.0) * (last - first); }
};

void draw_track(const Track& track, double now, std::optional<double> under_mouse, bool is_hovered) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float middle = track.at.y + 0.5f * track.size.y, half = units(2.0);
  const float here = track.x_of(now);
  list.AddRectFilled({track.at.x, middle - half}, {track.at.x + track.size.x, middle + half}, palette::pressed, half);
  list.AddRectFilled({track.at.x, middle - half}, {here, middle + half}, palette::accent, half);
  if (under_mouse && *under_mouse >= track.first && *under_mouse <= track.last)
    list.AddLine({track.x_of(*under_mouse), middle - units(8.0)}, {track.x_of(*under_mouse), middle + units(8.0)}, palette::dim,
                 units(1.0));
  list.AddCircleFilled({here, middle}, units(is_hovered ? 7.0 : 5.5), palette::text);
}

// The recorded frames.
void scrubber(const PanelInput& input, const Track& track, Panels& panels, Requests& requests) {
  const Status& status = input.status;
  ImGui::SetCursorScreenPos(track.at);
  ImGui::InvisibleButton("past", track.size);
  const bool has_past = track.last > track.first;
  if (has_past && ImGui::IsItemActive()) {
    const double time = track.time_at(ImGui::GetIO().MousePos.x);
    // slightly later, so that rounding does not select the previous frame
    const double target = time + 1e-3 / status.snapshot->settings.frame_rate;
    requests.emplace_back(Scrub{target, std::exchange(panels.plots.timeline.scrub_in_progress, true)});
  } else {
    panels.plots.timeline.scrub_in_progress = false;
    if (has_past && ImGui::IsItemHovered()) {
      panels.plots.next_time_under_mouse = track.time_at(ImGui::GetIO().MousePos.x);
      tooltip("Go to " + seconds(*panels.plots.next_time_under_mouse));
    }
    if (!has_past) tooltip("Recorded frames of the run; drag to return to one");
  }
  draw_track(track, status.snapshot->state.time, panels.plots.time_under_mouse,
             has_past && (ImGui::IsItemHovered() || ImGui::IsItemActive()));
}

// "Run to [10 s]", or the progress of such a run.
void run_to(const PanelInput& input, float x, float width, Panels& panels, Requests& requests) {
  const Status& status = input.status;
  const float y = static_cast<float>(input.layout.timeline.y) + units(3.0);
  ImGui::SetCursorScreenPos({x, y});
  if (status.run.to > 0.0) {
    const double done = (status.snapshot->state.time - status.run.from) / (status.run.to - status.run.from);
    char text[48];
    std::snprintf(text, sizeof text, "to %s: %.0f %%", seconds(status.run.to).c_str(), 100.0 * std::clamp(done, 0.0, 1.0));
    ImGui::SetCursorScreenPos({x, y + units(3.0)});
    text_in(palette::accent, text);
    ImGui::SameLine(0.0f, units(10.0));
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - units(3.0));
    if (ImGui::SmallButton("Stop")) requests.emplace_back(Control(SetRunning{false}));
    return;
  }
  ImGui::SetCursorScreenPos({x, y + units(3.0)});
  dim_text("Run to");
  ImGui::SetCursorScreenPos({x + units(48.0), y});
  ImGui::SetNextItemWidth(width - units(48.0));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {units(6.0), units(2.0)});
  const bool entered =
      ImGui::InputDouble("##run_to", &panels.plots.timeline.run_to, 0.0, 0.0, "%.6g s", ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::PopStyleVar();
  tooltip("Simulation time: Enter runs to it as fast as possible, or goes back to it");
  if (!entered || !std::isfinite(panels.plots.timeline.run_to)) return;
  requests.emplace_back(Control(RunTo{panels.plots.timeline.run_to}));
  // older frames are not kept
  if (panels.plots.timeline.run_to < status.timeline.start)
    panels.show_toast("The oldest recorded frame is at " + seconds(status.timeline.start));
}

}  // namespace

void build_timeline(const PanelInput& input, Panels& panels, Requests& requests) {
  const Rect& strip = input.layout.timeline;
  if (strip.height <= 0.0) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(8.0), units(2.0)});
  begin_panel("timeline", strip, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
  ImGui::GetWindowDrawList()->AddLine(corner(strip), {static_cast<float>(strip.x + strip.width), static_cast<float>(strip.y)},
                                      palette::line);
  ImGui::PushFont(fonts().small);

  const Status& status = input.status;
  const float left = static_cast<float>(strip.x) + units(8.0), top = static_cast<float>(strip.y);
  const float right = static_cast<float>(strip.x + strip.width) - units(8.0);
  // a short strip shows only the track
  const bool is_long = strip.width > units(440.0);
  const float run_width = units(is_long ? 128.0 : 0.0), label = units(is_long ? 64.0 : 10.0);
  const ImVec2 button{units(26.0), units(24.0)};
  ImGui::SetCursorScreenPos({left, top + units(3.0)});
  if (icon_button("back", Icon::StepBack, button, false, status.snapshot->state.time > status.timeline.start))
    requests.emplace_back(Action::StepBack);
  tooltip(Action::StepBack);

  // the track, between the times of its ends
  const float text_y = top + units(8.0);
  const Track track{{left + button.x + label, top},
                    {right - run_width - units(16.0) - label - (left + button.x + label), units(30.0)},
                    status.timeline.start,
                    status.timeline.end};
  if (track.size.x > units(60.0)) {
    const auto place_text = [&](float x, const std::string& text) {
      ImGui::GetWindowDrawList()->AddText({x, text_y}, palette::dim, text.c_str());
    };
    const std::string first = seconds(track.first);
    if (is_long) place_text(track.at.x - units(10.0) - ImGui::CalcTextSize(first.c_str()).x, first);
    if (is_long) place_text(track.at.x + track.size.x + units(10.0), seconds(track.last));
    scrubber(input, track, panels, requests);
  }
  if (is_long) run_to(input, right - run_width, run_width, panels, requests);
  ImGui::PopFont();
  ImGui::End();
}

}  // namespace hooke
