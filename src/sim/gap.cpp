#include "sim/gap.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace hooke {
namespace {

Gap gap_to(const Plane& plane, double radius, const Vec3& x) {
  return {glm::dot(plane.normal, x - plane.point) - radius, plane.normal, 0.0};
}

Gap gap_to(const Sphere& sphere, double radius, const Vec3& x) {
  const Vec3 out = x - sphere.center;
  const double length = glm::length(out), reach = sphere.radius + radius;
  return {length - reach, length > 0.0 ? out / length : Vec3(0.0, 1.0, 0.0), 1.0 / reach};
}

Gap gap_to(const Box& box, double radius, const Vec3& x) {
  const Vec3 out = x - glm::clamp(x, box.least, box.most);
  const double length = glm::length(out);
  if (length > 0.0) return {length - radius, out / length, 0.0};

  // inside: out through the nearest face
  Gap gap{-std::numeric_limits<double>::infinity(), {}, 0.0};
  for (int c = 0; c < 3; ++c)
    for (const double side : {-1.0, 1.0}) {
      const double distance = side > 0.0 ? x[c] - box.most[c] : box.least[c] - x[c];
      if (distance <= gap.distance) continue;
      gap.distance = distance;
      gap.normal = Vec3(0.0);
      gap.normal[c] = side;
    }
  gap.distance -= radius;
  return gap;
}

bool may_touch(const Plane& plane, double reach, const Vec3& middle, const Vec3& half) {
  const Vec3& n = plane.normal;
  const double way = std::abs(n.x * half.x) + std::abs(n.y * half.y) + std::abs(n.z * half.z);
  return glm::dot(n, middle - plane.point) <= reach + way;
}

bool may_touch(const Sphere& sphere, double reach, const Vec3& middle, const Vec3& half) {
  const Vec3 out = middle - sphere.center;
  const double way = sphere.radius + reach + std::abs(half.x) + std::abs(half.y) + std::abs(half.z);
  return glm::dot(out, out) <= way * way;
}

bool may_touch(const Box& box, double reach, const Vec3& middle, const Vec3& half) {
  for (int c = 0; c < 3; ++c) {
    const double way = reach + std::abs(half[c]);
    if (middle[c] < box.least[c] - way || middle[c] > box.most[c] + way) return false;
  }
  return true;
}

// When c + v t + a t^2 / 2, c >= 0, first goes below zero; in the form without cancellation.
std::optional<double> first_descent(double c, double v, double a) {
  if (v >= 0.0 && a >= 0.0) return std::nullopt;
  const double discriminant = v * v - 2.0 * a * c;
  if (discriminant < 0.0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  if (v > 0.0) return (v + root) / -a;
  return c == 0.0 ? 0.0 : 2.0 * c / (root - v);
}

// How long the path surely stays outside a convex body whose nearest point is at `gap`: until it meets the tangent plane
// there. None: for ever.
std::optional<double> time_outside(const Gap& gap, const Parabola& path) {
  return first_descent(std::max(0.0, gap.distance), glm::dot(gap.normal, path.v), glm::dot(gap.normal, path.a));
}

// The same for `within`, minding that a ball bends away: with d from its centre, d.d grows by
//   2 d.v t + (v.v + d.a) t^2 + v.a t^3 + a.a t^4 / 4  >=  2 d.v t + (v.v + d.a - |v.a| within) t^2.
std::optional<double> time_outside(const Sphere& sphere, double radius, const Gap& gap, const Parabola& path, double within) {
  const Vec3 d = path.x - sphere.center;
  const double c = std::max(0.0, gap.distance) * (glm::length(d) + sphere.radius + radius);
  const double square = glm::dot(path.v, path.v) + glm::dot(d, path.a) - std::abs(glm::dot(path.v, path.a)) * within;
  return first_descent(c, 2.0 * glm::dot(d, path.v), 2.0 * square);
}

}  // namespace

Gap gap_to(const Collider& collider, double radius, const Vec3& x) {
  return std::visit([&](const auto& shape) { return gap_to(shape, radius, x); }, collider.shape);
}

double touching(const Vec3& x) { return 1e-13 * (1.0 + std::abs(x.x) + std::abs(x.y) + std::abs(x.z)); }

bool may_touch(const Collider& collider, double radius, const Vec3& from, const Vec3& to, double bulge) {
  const Vec3 middle = 0.5 * (from + to), half = 0.5 * (to - from);
  const double reach = radius + bulge + touching(middle);
  return std::visit([&](const auto& shape) { return may_touch(shape, reach, middle, half); }, collider.shape);
}

std::optional<double> first_impact(const Collider& collider, double radius, const Parabola& path, double within) {
  const auto* sphere = std::get_if<Sphere>(&collider.shape);

  // go on for as long as the path surely stays outside, until it touches: Newton's method, in effect, quadratic where
  // the path crosses the surface, halving where it grazes
  constexpr int most_steps = 128;
  const double least_step = 1e-9 * within;
  double t = 0.0;
  for (int i = 0; i < most_steps; ++i) {
    const Parabola rest{path.position(t), path.velocity(t), path.a};
    const Gap gap = gap_to(collider, radius, rest.x);
    const double approach = glm::dot(gap.normal, rest.v);
    const bool touches = gap.distance <= touching(rest.x);
    if (touches && approach < 0.0) return t;

    std::optional<double> outside = time_outside(gap, rest);
    if (outside && sphere != nullptr) {
      const auto bending_away = time_outside(*sphere, radius, gap, rest, within - t);
      outside = bending_away ? std::optional(std::max(*outside, *bending_away)) : std::nullopt;
    }
    if (!outside) return std::nullopt;
    if (touches && *outside == 0.0) return t;
    t += touches ? std::max(*outside, least_step) : *outside;
    if (t > within) return std::nullopt;
  }
  return t;
}

}  // namespace hooke
