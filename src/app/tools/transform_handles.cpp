#include "app/tools/transform_handles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "ui/text.h"

namespace hooke {
namespace {

constexpr double margin = 18.0, stem = 26.0, handle_reach = 9.0;  // [design units]

// The corners of the box around the selected points in the picture, and above it the handle that turns. [px]
struct Handles {
  std::array<glm::dvec2, 4> corners;
  glm::dvec2 turn{0.0};
};
std::optional<Handles> handles_of(const ToolContext& context) {
  glm::dvec2 min(INFINITY), max(-INFINITY);
  std::size_t seen_points = 0;
  for (const PointId id : context.selection.points) {
    if (context.system().index_of(id) == no_index) continue;
    const auto seen = project_to_screen(context.view_transform(), context.snapshot().position(id));
    if (!seen) return std::nullopt;
    min = glm::min(min, *seen);
    max = glm::max(max, *seen);
    ++seen_points;
  }
  if (seen_points < 2) return std::nullopt;
  min -= margin * context.scale;
  max += margin * context.scale;
  // the handle that turns is above the box, or below it where there is no room
  const double above = min.y - stem * context.scale, lowest = context.size.y - margin * context.scale;
  const double turn = above > margin * context.scale ? above : std::min(max.y + stem * context.scale, lowest);
  return Handles{{min, {max.x, min.y}, max, {min.x, max.y}}, {0.5 * (min.x + max.x), turn}};
}

}  // namespace

bool TransformHandles::begin(const Pointer& pointer, ToolContext& context) {
  const auto handles = handles_of(context);
  if (!handles) return false;
  const auto is_at = [&](const glm::dvec2& at) { return glm::distance(at, pointer.at) <= handle_reach * context.scale; };
  turns_ = is_at(handles->turn);
  if (!turns_ && std::none_of(handles->corners.begin(), handles->corners.end(), is_at)) return false;
  start_ = context.status->snapshot;
  points_ = context.selection.points;
  pressed_at_ = pointer.at;
  has_moved_ = false;
  gesture_ = context.begin_gesture();
  text_ = turns_ ? "drag to turn; Ctrl: by 15 degrees" : "drag to scale";
  return true;
}

void TransformHandles::follow(const Pointer& pointer, ToolContext& context) {
  if (!start_ || !(has_moved_ || context.is_drag(pressed_at_, pointer.at))) return;
  const Vec3 center = center_of(*start_, points_);
  const auto seen = project_to_screen(context.view_transform(), center);
  if (!seen) return;
  Affine affine{.about = center};
  const glm::dvec2 from = pressed_at_ - *seen, to = pointer.at - *seen;
  if (turns_) {
    double angle = std::atan2(from.y, from.x) - std::atan2(to.y, to.x);
    angle = std::remainder(angle, 2.0 * std::numbers::pi);
    if (pointer.modifiers.control) angle = std::numbers::pi / 12.0 * std::round(angle / (std::numbers::pi / 12.0));
    affine.turn = rotation(context.system().dimensions == 2 ? Vec3(0.0, 0.0, 1.0) : context.camera.back, angle);
    text_ = "turned by " + number_text(std::round(1800.0 / std::numbers::pi * angle) / 10.0) + " degrees; Esc undoes";
  } else {
    affine.scale = std::max(0.01, glm::length(to) / std::max(1.0, glm::length(from)));
    text_ = "scaled to " + number_text(std::round(1000.0 * affine.scale) / 10.0) + " %, rest lengths too; Esc undoes";
  }
  has_moved_ = true;
  const std::string name = (turns_ ? "turn " : "scale ") + count(std::ssize(points_), "point");
  for (Command& command : moved(*start_, points_, affine)) context.lab.submit(std::move(command), gesture_, name);
}

void TransformHandles::revert(ToolContext& context) {
  if (start_ && has_moved_) context.lab.submit(Undo{});
  start_.reset();
}

void TransformHandles::mark(const ToolContext& context, Marks& marks) const {
  const auto handles = handles_of(context);
  if (!handles) return;
  const Vec3 center = center_of(context.snapshot(), context.selection.points);
  const auto at = [&](const glm::dvec2& seen) { return context.point_in_view_plane(seen, center); };
  for (std::size_t c = 0; c < 4; ++c) {
    marks.ghost_nails.push_back(at(handles->corners[c]));
    marks.ghost_lines.emplace_back(at(handles->corners[c]), at(handles->corners[(c + 1) % 4]));
  }
  const glm::dvec2 center_in_picture = 0.5 * (handles->corners[0] + handles->corners[2]);
  marks.ghost_lines.emplace_back(at(center_in_picture), at(handles->turn));
  marks.ghost_point = at(handles->turn);
}

}  // namespace hooke
