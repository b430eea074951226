#include "draw/surface_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace hooke {
namespace {

double turned_by(double speed, double time) { return std::fmod(speed * time, 2.0 * std::numbers::pi); }

// How far a line of this direction may go from a place before a coordinate leaves -half..half; least > most: it never enters.
struct Span {
  double least, most;
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
    span.least = std::max(span.least, std::min(one, other));
    span.most = std::min(span.most, std::max(one, other));
  }
  return span;
}

}  // namespace

BallMeridians meridians_of(const Subject& subject, const ColliderPath& path) {
  const double speed = glm::length(path.spin);
  if (!(speed > 0.0) || !std::isfinite(speed)) return {};
  Vec3 across, along;
  span(path.spin / speed, across, along);
  const double angle = turned_by(speed, subject.snapshot.state.time);
  return {path.spin / speed, std::cos(angle) * across + std::sin(angle) * along};
}

void move_grid(GroundLook& look, const Subject& subject, const Plane& plane, const ColliderPath& path) {
  const double time = subject.snapshot.state.time;
  look.turn = turned_by(glm::dot(path.spin, plane.normal), time);
  look.run = path.offset(time) + time * path.belt;
}

void add_belt(const Subject& subject, const Box& box, const Vec3& belt, Ink line, Strokes& strokes) {
  constexpr double lines = 8.0;  // along the longest side
  const Vec3 half = 0.5 * (box.most - box.least), middle = box.least + half;
  const double spacing = 2.0 * std::max({half.x, half.y, half.z}) / lines;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    Vec3 normal(0.0), run = belt;
    normal[axis] = side % 2 == 0 ? -1.0 : 1.0;
    run[axis] = 0.0;
    const double speed = glm::length(run);
    if (!(speed > 0.0) || !(spacing > 0.0)) continue;
    const Vec3 along = run / speed, across = glm::cross(normal, along);
    const double reach = glm::dot(half, glm::abs(along)), gone = std::fmod(speed * subject.snapshot.state.time, spacing);
    for (double s = gone - spacing * std::ceil((reach + gone) / spacing); s < reach; s += spacing) {
      const auto [least, most] = span_within(half, s * along, across, axis);
      const Vec3 place = middle + half * normal + s * along;
      if (least < most)
        strokes.add(subject.projection, place + least * across, place + most * across, line, static_cast<float>(subject.options.scale),
                    4.0);
    }
  }
}

void add_diameters(const Subject& subject, const Sphere& disc, double spin, Ink line, Strokes& strokes) {
  constexpr int diameters = 3;
  const Vec3 center(disc.center.x, disc.center.y, 0.0);
  for (int i = 0; i < diameters; ++i) {
    const double angle = turned_by(spin, subject.snapshot.state.time) + std::numbers::pi * i / diameters;
    const Vec3 way = disc.radius * Vec3(std::cos(angle), std::sin(angle), 0.0);
    strokes.add(subject.projection, center - way, center + way, line, static_cast<float>(subject.options.scale));
  }
}

}  // namespace hooke
