#include "draw/camera_text.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "base/bounds.h"
#include "base/text_lines.h"

namespace hooke {
namespace {

constexpr std::string_view orthographic_word = "orthographic";

}  // namespace

std::string camera_text(const CameraPose& pose) {
  std::string text;
  for (const Vec3& place : {pose.eye, pose.target})
    for (int axis = 0; axis < 3; ++axis) text += (text.empty() ? "" : ",") + format_exact(place[axis]);
  return pose.orthographic ? text.append(",").append(orthographic_word) : text;
}

std::optional<CameraPose> camera_from_text(std::string_view text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.remove_suffix(1);
  std::vector<std::string_view> words = split(text, ',');
  CameraPose pose{.orthographic = words.back() == orthographic_word};
  if (pose.orthographic) words.pop_back();
  if (words.size() != 6) return std::nullopt;
  for (int i = 0; i < 6; ++i) {
    const auto number = parse_number(words[static_cast<std::size_t>(i)]);
    if (!number) return std::nullopt;
    (i < 3 ? pose.eye : pose.target)[i % 3] = *number;
  }
  const double distance = glm::distance(pose.eye, pose.target);
  if (!(distance > 0.0) || !std::isfinite(distance)) return std::nullopt;
  return pose;
}

}  // namespace hooke
