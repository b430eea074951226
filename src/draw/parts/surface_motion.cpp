#include "draw/parts/surface_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace hooke {
namespace {

double turned_by(double speed, double time) { return std::fmod(speed * time, 2.0 * std::numbers::pi); }

// The parameter range of a line inside the box -half..half; min > max: the line misses the box.
struct Span {
  double min, max;
};
Span span_within(const Vec3& half, const Vec3& place, const Vec3& direction, int except) {
  Span span{-2.0 * glm::length(half), 2.0 * glm::length(half)};
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == except) continue;
    if (std::abs(direction[axis]) < 1e-9) {
      if (std::abs(place[axis]) > half[axis]) return {1.0, 0.0};
      continue;
    }
    const double one = (half[axis] - place[axis]) / direction[axis], other = (-half[axis] - place[axis]) / direction[axis];
    span.min = std::max(span.min, std::min(one, other));
    span.max = std::min(span.max, std::max(one, other));
  }
  return span;
}

}  // namespace

BallMeridians meridians_of(const DrawContext& context, const ColliderPath& path) {
  const double speed = glm::length(path.spin);
  if (!(speed > 0.0) || !std::isfinite(speed)) return {};
  Vec3 across, along;
  span(path.spin / speed, across, along);
  const double angle = turned_by(speed, context.snapshot.state.time);
  return {path.spin / speed, std::cos(angle) * across + std::sin(angle) * along};
}

void move_grid(GroundStyle& style, const DrawContext& context, const Plane& plane, const ColliderPath& path) {
  const double time = context.snapshot.state.time;
  style.turn = turned_by(glm::dot(path.spin, plane.normal), time);
  style.run = path.offset(time) + time * path.belt;
}

void add_belt(const DrawContext& context, const Box& box, const Vec3& belt, Rgba line, Strokes& strokes) {
  constexpr double lines = 8.0;  // along the longest side
  const Vec3 half = 0.5 * (box.max - box.min), middle = box.min + half;
  const double spacing = 2.0 * std::max({half.x, half.y, half.z}) / lines;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    Vec3 normal(0.0), along_belt = belt;
    normal[axis] = side % 2 == 0 ? -1.0 : 1.0;
    along_belt[axis] = 0.0;
    const double speed = glm::length(along_belt);
    if (!(speed > 0.0) || !(spacing > 0.0)) continue;
    const Vec3 along = along_belt / speed, across = glm::cross(normal, along);
    const double reach = glm::dot(half, glm::abs(along)), shift = std::fmod(speed * context.snapshot.state.time, spacing);
    for (double s = shift - spacing * std::ceil((reach + shift) / spacing); s < reach; s += spacing) {
      const auto [min, max] = span_within(half, s * along, across, axis);
      const Vec3 place = middle + half * normal + s * along;
      if (min < max)
        strokes.add(context.projection, place + min * across, place + max * across, line, static_cast<float>(context.options.scale), 4.0);
    }
  }
}

void add_diameters(const DrawContext& context, const Sphere& disc, double spin, Rgba line, Strokes& strokes) {
  constexpr int diameters = 3;
  const Vec3 center(disc.center.x, disc.center.y, 0.0);
  for (int i = 0; i < diameters; ++i) {
    const double angle = turned_by(spin, context.snapshot.state.time) + std::numbers::pi * i / diameters;
    const Vec3 radius_vector = disc.radius * Vec3(std::cos(angle), std::sin(angle), 0.0);
    strokes.add(context.projection, center - radius_vector, center + radius_vector, line, static_cast<float>(context.options.scale));
  }
}

}  // namespace hooke
