#include "app/tools/tool_context.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scene/warnings/warnings.h"

namespace hooke {
namespace {

// [design units]
constexpr double reach = 10.0, spring_reach = 8.0, drag_threshold = 4.0;
// [px], at any interface scale
constexpr double min_reach = 8.0;

}  // namespace

void ToolContext::take_status() {
  const auto before = std::exchange(status, lab.status());
  if (!status->run.running || before->run.frames != status->run.frames) frame_seen = std::chrono::steady_clock::now();
  if (before->snapshot->system != status->snapshot->system) selection = existing_part_of(system(), selection);
}

bool ToolContext::settle() {
  const bool settled = lab.settle(patience);
  take_status();
  return settled;
}

void ToolContext::note_gaps(const Collider& collider) {
  if (const auto text = small_collider_text(system(), snapshot().state, collider)) notice = "Note: " + *text;
}

SetColliders removal_of_collider(Index collider, const ToolContext& context) {
  std::vector<Collider> colliders = carried_colliders(context.system(), context.snapshot().state);
  colliders.erase(colliders.begin() + collider);
  return {std::move(colliders)};
}

std::optional<PointId> ToolContext::point_at(const glm::dvec2& cursor) const {
  return pick_point(snapshot(), view_transform(), cursor, std::max(min_reach, reach * scale));
}

std::optional<SpringId> ToolContext::spring_at(const glm::dvec2& cursor) const {
  return pick_spring(snapshot(), view_transform(), cursor, std::max(min_reach, spring_reach * scale));
}

std::optional<SurfaceHit> ToolContext::surface_at(const glm::dvec2& cursor) const {
  return shows_surface ? pick_surface(snapshot(), view_transform(), cursor) : std::nullopt;
}

std::optional<ColliderHit> ToolContext::collider_at(const glm::dvec2& cursor) const {
  return pick_collider(snapshot(), view_transform(), cursor);
}

Vec3 ToolContext::point_in_view_plane(const glm::dvec2& cursor, const Vec3& through) const {
  if (system().dimensions == 3) return camera.unproject(cursor, size, through);
  const PickRay line = pick_ray(view_transform(), cursor);
  // seen edge-on, the plane has no point under the cursor
  if (std::abs(line.direction.z) < 1e-6) return through;
  return line.at(-line.origin.z / line.direction.z);
}

Vec3 ToolContext::on_grid(const Vec3& place) const {
  const double spacing = grid_spacing(camera);
  const Vec3 snapped = spacing * glm::round(place / spacing);
  // in space the grid is horizontal, and the depth of the view plane stays
  return system().dimensions == 2 ? snapped : snapped + glm::dot(place - snapped, camera.back) * camera.back;
}

Vec3 ToolContext::place_beside(const Pointer& pointer, const Vec3& from) const {
  const Vec3 place = point_in_view_plane(pointer.at, from);
  return pointer.modifiers.control ? on_grid(place) : place;
}

Vec3 ToolContext::place_for_point(const Pointer& pointer, double radius) const {
  const Vec3 beside = place_beside(pointer, camera.target);
  if (system().dimensions == 2) return beside;
  const PickRay line = pick_ray(view_transform(), pointer.at);
  const std::optional<ColliderHit> hit = hit_collider(system(), snapshot().state, line);
  if (!hit) return beside;
  // an infinite ground plane is under almost every cursor position: it counts only in front of the plane of the target
  const bool nearer = hit->distance < glm::dot(beside - line.origin, line.direction);
  return hit->bounded || nearer ? hit->position + radius * hit->normal : beside;
}

bool ToolContext::is_drag(const glm::dvec2& from, const glm::dvec2& to) const { return glm::distance(from, to) > drag_threshold * scale; }

}  // namespace hooke
