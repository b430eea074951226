#include "draw/parts/spring_shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace hooke {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double coil_turns = 10.0, coil_radius = 0.07;  // radius relative to the rest length
constexpr double wave_height = 3.5;                      // [px of the screen], of a muscle with an amplitude of 1/4 or more
constexpr double wave_cycles = 3.0;
constexpr float cable_width = 0.6f;     // relative to other springs
constexpr double min_coil_pixels = 30;  // [px of the screen]: shorter springs are lines

// Two unit vectors across the spring, the first one parallel to the picture.
struct Across {
  Vec3 in_picture, of_depth;
};
Across across(const DrawContext& context, const Vec3& along) {
  const Vec3 view = context.camera.target - context.camera.eye();
  Vec3 first = glm::cross(along, view);
  if (!(glm::length(first) > 0.0)) first = glm::cross(along, Vec3(0.3, 0.9, 0.3));
  first = glm::normalize(first);
  return {first, glm::normalize(glm::cross(first, along))};
}

// offset(s), s from 0 to 1 along the spring
template <class Offset>
void add_curve(const DrawContext& context, const Vec3& from, const Vec3& to, int parts, Rgba color, float width, double depth_offset,
               Strokes& strokes, const Offset& offset) {
  Vec3 last = from;
  for (int i = 1; i <= parts; ++i) {
    const double s = static_cast<double>(i) / parts;
    const Vec3 next = from + s * (to - from) + offset(s);
    strokes.add(context.projection, last, next, color, width, depth_offset);
    last = next;
  }
}

}  // namespace

bool add_spring_curve(const DrawContext& context, const Spring& spring, const Vec3& from, const Vec3& to, Rgba color, float& width,
                      double depth_offset, Strokes& strokes) {
  const System& system = *context.snapshot.system;
  const double time = context.snapshot.state.time, length = glm::distance(from, to), rest_length = system.rest_length_of(spring, time);
  if (!std::isfinite(length) || !(length > 0.0)) return false;
  const double pixel = context.camera.meters_per_pixel(0.5 * (from + to), {context.projection.width(), context.projection.height()});
  const SpringLaw law = spring.law.value_or(SpringLaw{});

  const Vec3 along = (to - from) / length;
  const Across axes = across(context, along);

  // a slack cable hangs as the parabola of about its length; a vertical one aside
  if (law.force == SpringForce::Cable) {
    width *= cable_width;
    const double slack = rest_length - length, gravity = glm::length(system.gravity);
    if (!(slack > 0.0) || !(gravity > 0.0)) return false;
    const double sag = std::min(std::sqrt(0.375 * length * slack) + 0.5 * slack * slack / rest_length, 0.5 * rest_length);
    const Vec3 down = system.gravity / gravity, hanging = down - glm::dot(down, along) * along;
    const Vec3 aside = glm::dot(axes.in_picture, hanging) < 0.0 ? -axes.in_picture : axes.in_picture;
    const Vec3 direction = glm::normalize(hanging + (1.0 - glm::length(hanging)) * aside);
    add_curve(context, from, to, 16, color, width, depth_offset, strokes, [&](double s) { return 4.0 * s * (1.0 - s) * sag * direction; });
    return true;
  }

  // a wave runs along a muscle, with its phase in the middle
  if (law.amplitude != 0.0) {
    const double height = wave_height * context.options.scale * pixel * std::min(1.0, 4.0 * std::abs(law.amplitude));
    const double phase = two_pi * law.frequency * system.muscles.at(time) + law.phase;
    add_curve(context, from, to, 36, color, width, depth_offset, strokes, [&](double s) {
      return height * std::sin(std::numbers::pi * s) * std::sin(two_pi * wave_cycles * (s - 0.5) + phase) * axes.in_picture;
    });
    return true;
  }

  if (!context.options.coils || length < min_coil_pixels * context.options.scale * pixel) return false;
  const double radius = coil_radius * (rest_length > 0.0 ? rest_length : length);
  add_curve(context, from, to, static_cast<int>(12.0 * coil_turns), color, 0.8f * width, depth_offset, strokes, [&](double s) {
    const double end = 0.08, fade = std::clamp(std::min(s, 1.0 - s) / end - 1.0, 0.0, 1.0), angle = two_pi * coil_turns * s;
    return radius * fade * (std::sin(angle) * axes.in_picture + std::cos(angle) * axes.of_depth);
  });
  return true;
}

}  // namespace hooke
