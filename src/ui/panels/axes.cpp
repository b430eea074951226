// The world axes in a corner of the scene, as seen by the camera; clicking an end looks from that direction.
#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

constexpr double side = 88.0, reach = 31.0, ball = 8.5;  // [design units]

struct End {
  Vec3 direction;
  const char* name;  // null for the negative ends
  ImU32 color;
};

struct ProjectedEnd {
  End end;
  ImVec2 at;
  double depth;  // towards the viewer
};

std::array<ProjectedEnd, 6> seen_ends(const Camera& camera, ImVec2 center) {
  const ImU32 red = palette::axis_x, green = palette::axis_y, blue = palette::axis_z;
  const End ends[] = {{{1.0, 0.0, 0.0}, "x", red},      {{0.0, 1.0, 0.0}, "y", green},      {{0.0, 0.0, 1.0}, "z", blue},
                      {{-1.0, 0.0, 0.0}, nullptr, red}, {{0.0, -1.0, 0.0}, nullptr, green}, {{0.0, 0.0, -1.0}, nullptr, blue}};
  const Vec3 right = glm::cross(camera.up, camera.back);
  std::array<ProjectedEnd, 6> seen;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Vec3& direction = ends[i].direction;
    seen[i] = {ends[i],
               {center.x + units(reach * glm::dot(direction, right)), center.y - units(reach * glm::dot(direction, camera.up))},
               glm::dot(direction, camera.back)};
  }
  std::ranges::sort(seen, {}, &ProjectedEnd::depth);
  return seen;
}

bool is_over(const ProjectedEnd& end) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  return std::hypot(mouse.x - end.at.x, mouse.y - end.at.y) <= units(ball + 1.5);
}

void draw(ImDrawList& list, const ProjectedEnd& seen, ImVec2 center, bool highlighted) {
  const float radius = units(highlighted ? ball + 1.0 : ball);
  if (seen.end.name == nullptr) {
    list.AddCircleFilled(seen.at, 0.7f * radius, highlighted ? palette::hovered : palette::box);
    list.AddCircle(seen.at, 0.7f * radius, seen.end.color, 0, units(1.3));
    return;
  }
  list.AddLine(center, seen.at, seen.end.color, units(2.0));
  list.AddCircleFilled(seen.at, radius, seen.end.color);
  const ImVec2 size = ImGui::CalcTextSize(seen.end.name);
  list.AddText({seen.at.x - 0.5f * size.x, seen.at.y - 0.54f * size.y}, palette::panel, seen.end.name);
}

}  // namespace

void build_axes(const PanelInput& input, Panels& panels, Requests& requests) {
  const Rect& scene = input.layout.scene;
  const bool fits = scene.width > 4.0 * units(side) && scene.height > 3.0 * units(side);
  if (input.status.snapshot->system->dimensions != 3 || !fits) return;
  const Rect place{scene.x + scene.width - units(side) - units(8.0), scene.y + units(8.0), units(side), units(side)};
  begin_panel("axes", place, ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  panels.shown.floating.push_back(place);

  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 center{static_cast<float>(place.x + 0.5 * place.width), static_cast<float>(place.y + 0.5 * place.height)};
  ImGui::PushFont(fonts().small);
  const auto ends = seen_ends(input.camera, center);
  // of overlapping ends, the one nearest to the viewer
  const bool hovered = ImGui::IsWindowHovered();
  const auto under = std::ranges::find_if(ends.rbegin(), ends.rend(), is_over);
  for (const ProjectedEnd& end : ends) draw(list, end, center, hovered && under != ends.rend() && &end == &*under);
  ImGui::PopFont();
  if (hovered && under != ends.rend() && ImGui::IsMouseClicked(ImGuiMouseButton_Left))
    requests.emplace_back(LookFrom{under->end.direction});
  ImGui::End();
}

}  // namespace hooke
