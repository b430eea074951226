// The steps of the lesson "How wrong is it?": each is checked off as soon as the user has done it.
#include <algorithm>
#include <cmath>
#include <string>

#include "lab/accuracy/accuracy_text.h"
#include "ui/panels.h"
#include "ui/text.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

struct LessonStep {
  const char* text;
  bool (*is_done)(const PanelInput& input, const Panels& panels);
  // What the user sees now, once the step is done; empty: nothing to add.
  std::string (*result)(const PanelInput& input);
};

constexpr const char* lesson_name = "How wrong is it?";
constexpr int first_substeps = 20;

constexpr LessonStep lesson_steps[] = {
    {"Press M: the meter shows four quantities.", [](const PanelInput&, const Panels& panels) { return panels.shown.accuracy; },
     [](const PanelInput&) { return std::string(); }},
    {"Press Space and wait until the meter says for how long the motion is predictable.",
     [](const PanelInput& input, const Panels&) {
       const Accuracy& accuracy = input.status.accuracy;
       return accuracy.predictable.value && std::isfinite(*accuracy.predictable.value) && accuracy.frame.value.has_value();
     },
     [](const PanelInput&) { return std::string(); }},
    {"Go back with Ctrl+R, double the substeps (the slider, or Right) and run again: the error of a frame falls to a quarter.",
     [](const PanelInput& input, const Panels&) {
       const Snapshot& now = *input.status.snapshot;
       const Accuracy& accuracy = input.status.accuracy;
       return now.settings.substeps >= 2 * first_substeps && accuracy.frame.value && accuracy.frame_time > 0.0 &&
              accuracy.frame_time <= now.state.time;
     },
     [](const PanelInput& input) {
       const Accuracy& accuracy = input.status.accuracy;
       return accuracy.frame.value ? "error of a frame: " + length_text(*accuracy.frame.value) : std::string();
     }},
    {"Ctrl+R, then Ctrl+Shift+G: a ghost shows the reference. Run until it is 10 cm away.",
     [](const PanelInput& input, const Panels&) {
       return std::ranges::any_of(input.status.companions.list,
                                  [](const CompanionStatus& ghost) { return ghost.positions && ghost.distance >= 0.1; });
     },
     [](const PanelInput& input) {
       const auto& list = input.status.companions.list;
       return list.empty() ? std::string() : "distance: " + length_text(list.front().distance);
     }},
    {"Ctrl+Shift+M: the chart of all methods. Click on a point of it to use that method.",
     [](const PanelInput& input, const Panels&) {
       const auto& compared = input.results.comparison.result;
       const Settings& now = input.status.snapshot->settings;
       return compared && std::ranges::any_of(compared->record.rows, [&](const Row& row) {
                return row.method == now.integrator->id && substeps_of(row, now.frame_rate) == now.substeps;
              });
     },
     [](const PanelInput&) { return std::string(); }},
};

void check_box(bool is_done) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float size = units(11.0), y = at.y + units(3.0);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRect({at.x, y}, {at.x + size, y + size}, is_done ? palette::good : palette::dim, units(2.0), 0, units(1.2));
  if (is_done) {
    const ImVec2 tick[] = {
        {at.x + 0.22f * size, y + 0.55f * size}, {at.x + 0.43f * size, y + 0.76f * size}, {at.x + 0.8f * size, y + 0.26f * size}};
    list.AddPolyline(tick, 3, palette::good, 0, units(1.8));
  }
  ImGui::Dummy({size, size});
  ImGui::SameLine(0.0f, units(8.0));
}

}  // namespace

void build_lesson(const PanelInput& input, Panels& panels) {
  if (input.status.document->name != lesson_name) return;
  // in order: what is on the way to a later step does not count for it
  unsigned number = 0;
  for (const LessonStep& step : lesson_steps) {
    const unsigned bit = 1u << number;
    const bool was_reached = panels.side.lesson_steps_done + 1 >= bit;
    if (was_reached && (panels.side.lesson_steps_done & bit) == 0 && step.is_done(input, panels)) panels.side.lesson_steps_done |= bit;
    const bool is_done = (panels.side.lesson_steps_done & bit) != 0;
    ImGui::Spacing();
    check_box(is_done);
    ImGui::BeginGroup();
    paragraph(step.text, is_done ? palette::dim : was_reached ? palette::text : palette::dim);
    if (is_done)
      if (const std::string result = step.result(input); !result.empty()) paragraph(result, palette::good);
    ImGui::EndGroup();
    ++number;
  }
  ImGui::Spacing();
}

}  // namespace hooke
