#include "sim/contact.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

namespace hooke {
namespace {

// Signed distance [m] of a point's rim from a collider, and the outward normal there.
struct Gap {
  double distance = 0.0;
  Vec3 normal{0.0, 1.0, 0.0};
  double curvature = 0.0;  // [1/m], of the surface on which the point's centre slides
};

Gap gap_to(const Plane& plane, double radius, const Vec3& x) { return {glm::dot(plane.normal, x - plane.point) - radius, plane.normal, 0.0}; }

Gap gap_to(const Sphere& sphere, double radius, const Vec3& x) {
  const Vec3 out = x - sphere.center;
  const double length = glm::length(out);
  const Vec3 normal = length > 0.0 ? out / length : Vec3(0.0, 1.0, 0.0);
  return {length - sphere.radius - radius, normal, 1.0 / (sphere.radius + radius)};
}

Gap gap_to(const Box& box, double radius, const Vec3& x) {
  const Vec3 nearest = glm::clamp(x, box.least, box.most);
  const Vec3 out = x - nearest;
  const double length = glm::length(out);
  if (length > 0.0) return {length - radius, out / length, 0.0};

  // inside: out through the nearest face
  Gap gap{-1e300, {}, 0.0};
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

Gap gap_to(const Collider& collider, double radius, const Vec3& x) {
  return std::visit([&](const auto& shape) { return gap_to(shape, radius, x); }, collider.shape);
}

// x + v t + a t^2 / 2
struct Parabola {
  Vec3 x, v, a;
  Vec3 position(double t) const { return x + t * (v + 0.5 * t * a); }
  Vec3 velocity(double t) const { return v + t * a; }
  void advance(double t) {
    x = position(t);
    v = velocity(t);
  }
};

// When c + v t + a t^2 / 2, c >= 0, first goes below zero; in the form without cancellation.
std::optional<double> first_descent(double c, double v, double a) {
  if (v >= 0.0 && a >= 0.0) return std::nullopt;
  const double discriminant = v * v - 2.0 * a * c;
  if (discriminant < 0.0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  if (v > 0.0) return (v + root) / -a;
  return c == 0.0 ? 0.0 : 2.0 * c / (root - v);
}

std::optional<double> first_impact(const Plane& plane, double radius, const Parabola& path, double within) {
  const double gap = std::max(0.0, gap_to(plane, radius, path.x).distance);
  const auto t = first_descent(gap, glm::dot(plane.normal, path.v), glm::dot(plane.normal, path.a));
  return t && *t <= within ? t : std::nullopt;
}

// Any shape with a distance: advance by distance over the highest speed, which never jumps over the surface, and finish
// on the parabola against the tangent plane.
template <class Shape>
std::optional<double> first_impact(const Shape& shape, double radius, const Parabola& path, double within) {
  const double highest_speed = glm::length(path.v) + within * glm::length(path.a);
  Gap gap = gap_to(shape, radius, path.x);
  if (gap.distance > highest_speed * within) return std::nullopt;

  constexpr int most_steps = 200;
  double t = 0.0;
  for (int i = 0; i < most_steps; ++i) {
    const Parabola rest{path.position(t), path.velocity(t), path.a};
    gap = gap_to(shape, radius, rest.x);
    // on a curved surface the tangent plane recedes: v_t^2 / R outwards
    const Vec3 tangential = rest.v - glm::dot(rest.v, gap.normal) * gap.normal;
    const double away = glm::dot(gap.normal, rest.a) + gap.curvature * glm::dot(tangential, tangential);
    const double touching = 1e-13 * (1.0 + glm::length(rest.x));
    if (gap.distance <= touching) {
      const double approach = glm::dot(gap.normal, rest.v);
      if (approach < 0.0 || (approach == 0.0 && away < 0.0)) return t;
      const auto dip = first_descent(0.0, approach, away);
      if (!dip || t + *dip > within) return std::nullopt;
      t += std::max(*dip, 1e-6 * within);
      continue;
    }
    t += gap.distance / highest_speed;
    if (t > within) return std::nullopt;
  }
  return gap.distance < 1e-6 * radius ? std::optional(t) : std::nullopt;
}

// Slides `path` on the surface with normal n for `duration`: the normal acceleration is held by the surface, friction
// takes mu times it. Exact on a plane, sticking included.
void slide(Parabola& path, const Vec3& n, double friction, double pressing, double duration) {
  const Vec3 velocity = path.v - glm::dot(path.v, n) * n;
  const Vec3 drive = path.a - glm::dot(path.a, n) * n;
  const double most = friction * pressing;  // [m/s^2]
  const double speed = glm::length(velocity);

  // moving: friction against the motion, until it stops; at rest: against the drive, as far as it reaches
  Vec3 resisted = drive;
  double moving_for = duration;
  if (speed > 0.0) {
    resisted -= most / speed * velocity;
    const double slowing = -glm::dot(resisted, velocity) / speed;
    if (slowing > 0.0 && glm::length(drive) <= most) moving_for = std::min(duration, speed / slowing);
  } else {
    const double pull = glm::length(drive);
    resisted = pull <= most ? Vec3(0.0) : drive * (1.0 - most / pull);
  }
  path.x += moving_for * (velocity + 0.5 * moving_for * resisted);
  path.v = moving_for < duration ? Vec3(0.0) : velocity + moving_for * resisted;
}

struct Impact {
  double time;
  const Collider* collider;
};

std::optional<Impact> earliest_impact(const std::vector<Collider>& colliders, double radius, const Parabola& path, double within) {
  std::optional<Impact> earliest;
  for (const Collider& collider : colliders) {
    const auto time = std::visit([&](const auto& shape) { return first_impact(shape, radius, path, within); }, collider.shape);
    if (time && (!earliest || *time < earliest->time)) earliest = Impact{*time, &collider};
  }
  return earliest;
}

// Follows `path` for h through its impacts. Returns false, and leaves it as it was, when there is none.
bool follow(const std::vector<Collider>& colliders, double radius, Parabola& path, Vec3& lead, double h) {
  constexpr int most_impacts = 64;
  double left = h;
  for (int impacts = 0;; ++impacts) {
    const auto impact = earliest_impact(colliders, radius, path, left);
    if (!impact) {
      if (impacts > 0) path.advance(left);
      return impacts > 0;
    }
    path.advance(impact->time);
    left -= impact->time;

    // on the surface, to the last bit that matters
    const Collider& collider = *impact->collider;
    Gap gap = gap_to(collider, radius, path.x);
    path.x -= gap.distance * gap.normal;

    // restitution along the normal, Coulomb's impulse across it
    const double approach = std::min(0.0, glm::dot(path.v, gap.normal));
    const double rebound = -collider.restitution * approach;
    Vec3 tangential = path.v - glm::dot(path.v, gap.normal) * gap.normal;
    const double speed = glm::length(tangential);
    if (speed > 0.0) tangential *= std::max(0.0, 1.0 - collider.friction * (rebound - approach) / speed);
    const double centripetal = gap.curvature * glm::dot(tangential, tangential);
    const double pressing = -glm::dot(path.a, gap.normal) - centripetal;
    path.v = tangential + rebound * gap.normal;

    // all remaining bounces last 2 v / (a (1 - e)): if that is within the step, or there is no bounce, it rests and slides
    const bool settles = pressing > 0.0 && (rebound == 0.0 || 2.0 * rebound <= left * pressing * (1.0 - collider.restitution));
    if (settles || impacts == most_impacts) {
      slide(path, gap.normal, collider.friction, std::max(0.0, pressing), left);
      gap = gap_to(collider, radius, path.x);
      path.x -= gap.distance * gap.normal;
      path.v -= glm::dot(path.v, gap.normal) * gap.normal;
      lead -= std::min(0.0, glm::dot(lead, gap.normal)) * gap.normal;
      return true;
    }
  }
}

}  // namespace

bool resolve_contacts(const Plan& plan, const ContactWorkspace& before, Motion& motion, double h) {
  bool touched = false;
  const auto n = static_cast<std::size_t>(plan.points);
  const auto vector_at = [&](const Field& field, std::size_t i) {
    return Vec3(field[i], field[n + i], plan.dimensions == 3 ? field[2 * n + i] : 0.0);
  };

  for (std::size_t i = 0; i < n; ++i) {
    if (plan.inverse_mass[i] == 0.0) continue;

    // the parabola through both ends, and what the method added to its final velocity
    const Vec3 x0 = vector_at(before.x, i), v0 = vector_at(before.v, i);
    const Vec3 a = 2.0 * (vector_at(motion.x, i) - x0 - h * v0) / (h * h);
    Vec3 lead = vector_at(motion.v, i) - (v0 + h * a);
    Parabola path{x0, v0, a};
    if (!follow(plan.colliders, plan.radius[i], path, lead, h)) continue;

    touched = true;
    for (int c = 0; c < plan.dimensions; ++c) {
      motion.x[c * n + i] = path.x[c];
      motion.v[c * n + i] = path.v[c] + lead[c];
    }
  }
  return touched;
}

}  // namespace hooke
