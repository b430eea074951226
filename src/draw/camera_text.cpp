#include "draw/camera_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>

namespace hooke {
namespace {

constexpr std::string_view orthographic_word = ",orthographic";

std::string digits_of(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

bool take(std::string_view& text, char wanted) {
  if (text.empty() || text.front() != wanted) return false;
  text.remove_prefix(1);
  return true;
}

bool take(std::string_view& text, double& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return error == std::errc() && std::isfinite(number);
}

}  // namespace

std::string camera_text(const CameraPose& pose) {
  std::string text;
  for (const Vec3& place : {pose.eye, pose.target})
    for (int axis = 0; axis < 3; ++axis) text += (text.empty() ? "" : ",") + digits_of(place[axis]);
  return pose.orthographic ? text.append(orthographic_word) : text;
}

std::optional<CameraPose> camera_from_text(std::string_view text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.remove_suffix(1);
  std::array<double, 6> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if ((i > 0 && !take(text, ',')) || !take(text, numbers[i])) return std::nullopt;
  CameraPose pose{.eye = {numbers[0], numbers[1], numbers[2]}, .target = {numbers[3], numbers[4], numbers[5]}};
  pose.orthographic = text == orthographic_word;
  const double distance = glm::distance(pose.eye, pose.target);
  if ((!text.empty() && !pose.orthographic) || !(distance > 0.0) || !std::isfinite(distance)) return std::nullopt;
  return pose;
}

}  // namespace hooke
