#include "sim/contact/gap.h"

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
  const double length = glm::length(out), inflated_radius = sphere.radius + radius;
  return {length - inflated_radius, length > 0.0 ? out / length : Vec3(0.0, 1.0, 0.0), 1.0 / inflated_radius};
}

Gap gap_to(const Box& box, double radius, const Vec3& x) {
  const Vec3 out = x - glm::clamp(x, box.min, box.max);
  const double length = glm::length(out);
  if (length > 0.0) {
    // a point with a radius goes round edges on cylinders, and round corners on balls
    const Vec3 curved(out.x != 0.0, out.y != 0.0, out.z != 0.0);
    const bool is_round = radius > 0.0 && curved.x + curved.y + curved.z > 1.0;
    return {.distance = length - radius, .normal = out / length, .curvature = is_round ? 1.0 / radius : 0.0, .curved = curved};
  }

  // inside: out through the nearest face
  Gap gap{.distance = -std::numeric_limits<double>::infinity()};
  for (int c = 0; c < 3; ++c)
    for (const double side : {-1.0, 1.0}) {
      const double distance = side > 0.0 ? x[c] - box.max[c] : box.min[c] - x[c];
      if (distance <= gap.distance) continue;
      gap.distance = distance;
      gap.normal = Vec3(0.0);
      gap.normal[c] = side;
    }
  gap.distance -= radius;
  return gap;
}

// When c + v t + a t^2 / 2, c >= 0, first goes below zero; in the form without cancellation.
std::optional<double> first_zero_crossing(double c, double v, double a) {
  if (v >= 0.0 && a >= 0.0) return std::nullopt;
  const double discriminant = v * v - 2.0 * a * c;
  if (discriminant < 0.0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  if (v > 0.0) return (v + root) / -a;
  return c == 0.0 ? 0.0 : 2.0 * c / (root - v);
}

// A lower bound on the time that the path stays outside a convex body whose nearest point is at `gap`: until it reaches the tangent plane
// there. None: forever.
std::optional<double> min_time_outside(const Gap& gap, const Parabola& path) {
  return first_zero_crossing(std::max(0.0, gap.distance), glm::dot(gap.normal, path.v), glm::dot(gap.normal, path.a));
}

// The same up to `time_limit`, with the curvature of a sphere, which a point may leave while it still accelerates towards it: with d from
// its center, d.d grows by
//   2 d.v t + (v.v + d.a) t^2 + v.a t^3 + a.a t^4 / 4  >=  2 d.v t + (v.v + d.a - |v.a| within) t^2.
std::optional<double> min_time_outside(const Sphere& sphere, double radius, const Gap& gap, const Parabola& path, double time_limit) {
  const Vec3 d = path.x - sphere.center;
  const double c = std::max(0.0, gap.distance) * (glm::length(d) + sphere.radius + radius);
  const double square = glm::dot(path.v, path.v) + glm::dot(d, path.a) - std::abs(glm::dot(path.v, path.a)) * time_limit;
  return first_zero_crossing(c, 2.0 * glm::dot(d, path.v), 2.0 * square);
}

}  // namespace

Gap gap_to(const Collider& collider, double radius, const Vec3& x) {
  return std::visit([&](const auto& shape) { return gap_to(shape, radius, x); }, collider.shape);
}

double contact_tolerance(const Vec3& x) { return 1e-13 * (1.0 + std::abs(x.x) + std::abs(x.y) + std::abs(x.z)); }

std::optional<double> first_impact(const Collider& collider, double radius, const Parabola& path, double time_limit) {
  const auto* sphere = std::get_if<Sphere>(&collider.shape);

  // advance by the time that the path certainly stays outside, until it touches: effectively Newton's method, with quadratic convergence
  // where the path crosses the surface, and halving where it is tangential
  constexpr int max_steps = 128;
  const double min_step = 1e-9 * time_limit;
  double t = 0.0;
  for (int i = 0; i < max_steps; ++i) {
    const Parabola remaining{path.position(t), path.velocity(t), path.a};
    const Gap gap = gap_to(collider, radius, remaining.x);
    const double approach = glm::dot(gap.normal, remaining.v);
    const bool touches = gap.distance <= contact_tolerance(remaining.x);
    if (touches && approach < 0.0) return t;

    std::optional<double> outside = min_time_outside(gap, remaining);
    if (outside && sphere != nullptr) {
      const auto min_time_on_sphere = min_time_outside(*sphere, radius, gap, remaining, time_limit - t);
      outside = min_time_on_sphere ? std::optional(std::max(*outside, *min_time_on_sphere)) : std::nullopt;
    }
    if (!outside) return std::nullopt;
    if (touches && *outside == 0.0) return t;
    t += touches ? std::max(*outside, min_step) : *outside;
    if (t > time_limit) return std::nullopt;
  }
  return t;
}

}  // namespace hooke
