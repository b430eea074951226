// Moves, turns, scales, mirrors, aligns and distributes the selected points, by typing and by buttons.
#include "edit/arrange.h"

#include <numbers>

#include "ui/number_field.h"
#include "ui/panels.h"
#include "ui/text.h"
#include "ui/typed_field.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

constexpr const char* axes[] = {"x", "y", "z"};

// A field that starts at `neutral` again after each use.
std::optional<double> amount(const std::string& label, const char* unit, const char* description, double neutral, double limit,
                             Panels& panels) {
  ImGui::PushID(label.c_str());
  const auto value = typed_row(
      {.label = label, .unit = unit, .description = description, .min = neutral == 1.0 ? 0.001 : -limit, .max = limit, .value = neutral},
      panels);
  ImGui::PopID();
  return value;
}

// A button for each axis; the one that was pressed.
std::optional<int> axis_buttons(const char* label, const char* hint, int dimensions) {
  std::optional<int> pressed;
  begin_row(label);
  ImGui::PushID(label);
  for (int axis = 0; axis < dimensions; ++axis) {
    if (axis > 0) ImGui::SameLine();
    if (ImGui::Button(axes[axis], {units(36.0), 0.0f})) pressed = axis;
    tooltip(hint);
  }
  ImGui::PopID();
  return pressed;
}

}  // namespace

void build_arrange(const PanelInput& input, Panels& panels, Requests& requests) {
  if (input.selection.points.size() < 2 || !section("Arrange", "", false)) return;
  const int dimensions = input.status.snapshot->system->dimensions;
  const Snapshot& now = *input.status.snapshot;
  const std::vector<PointId>& points = input.selection.points;
  Affine affine{.about = center_of(now, points)};
  ImGui::PushID("arrange");
  for (int axis = 0; axis < dimensions; ++axis)
    if (const auto by = amount(std::string("Move ") + axes[axis], "m", "Moves all by this much.", 0.0, typed::max_length, panels))
      affine.shift[axis] = *by;
  std::string verb = "move";
  for (int axis = dimensions == 2 ? 2 : 0; axis < 3; ++axis)
    if (const auto by = amount(dimensions == 2 ? "Turn" : std::string("Turn about ") + axes[axis], "degrees",
                               "About the center of the points, counter-clockwise.", 0.0, 360.0, panels)) {
      Vec3 unit(0.0);
      unit[axis] = 1.0;
      affine.turn = rotation(unit, *by * std::numbers::pi / 180.0);
      verb = "turn";
    }
  if (const auto by = amount("Scale", "", "About the center of the points; rest lengths scale too.", 1.0, 1000.0, panels)) {
    affine.scale = *by;
    verb = "scale";
  }
  if (const auto axis = axis_buttons("Mirror", "Reverses this coordinate about the center of the points.", dimensions)) {
    affine.turn = reflection(*axis);
    verb = "mirror";
  }
  std::vector<Command> commands;
  if (affine.turn != glm::dmat3(1.0) || affine.scale != 1.0 || affine.shift != Vec3(0.0)) commands = moved(now, points, affine);
  if (const auto axis = axis_buttons("Align", "Gives all points the same coordinate, their mean.", dimensions)) {
    commands.push_back(aligned(now, points, *axis));
    verb = "align";
  }
  if (const auto axis = axis_buttons("Distribute", "Equal distances along this axis, between the outermost points.", dimensions)) {
    commands.push_back(distributed(now, points, *axis));
    verb = "distribute";
  }
  begin_row("Join");
  if (ImGui::Button("Weld", {units(74.0), 0.0f})) requests.emplace_back(Action::Weld);
  tooltip(Action::Weld);
  ImGui::SameLine();
  if (ImGui::Button("Split", {units(74.0), 0.0f})) requests.emplace_back(Action::Split);
  tooltip(Action::Split);
  ImGui::PopID();
  for (std::size_t i = 0; i < commands.size(); ++i)
    requests.emplace_back(Edit{std::move(commands[i]), i > 0, verb + " " + count(std::ssize(points), "point")});
}

}  // namespace hooke
