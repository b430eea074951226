// Detection: distances of points from colliders, and times of impact. All colliders are convex: they lie entirely behind the
// tangent plane at their nearest point.
#pragma once

#include <glm/geometric.hpp>
#include <optional>

#include "sim/model/system.h"

namespace hooke {

// Between the surface of a point, which has a radius, and a collider.
struct Gap {
  double distance = 0.0;       // [m], negative inside
  Vec3 normal{0.0, 1.0, 0.0};  // outward, where the collider is nearest
  double curvature = 0.0;      // [1/m], of the ball on which the center of the point slides, or of the edge of a box
  Vec3 curved{1.0};            // 0: an axis along which it is straight
};

// A path under constant acceleration: x + v t + a t^2 / 2.
struct Parabola {
  Vec3 x, v, a;
  Vec3 position(double t) const { return x + t * (v + 0.5 * t * a); }
  Vec3 velocity(double t) const { return v + t * a; }
};

// The component of w perpendicular to the unit vector `normal`.
inline Vec3 tangential(const Vec3& normal, const Vec3& w) { return w - glm::dot(w, normal) * normal; }

// Of a point of `radius` [m] at x. At the center of a sphere the normal is up.
Gap gap_to(const Collider& collider, double radius, const Vec3& x);

// Gaps up to this [m] count as contact: round-off of a point placed on a surface.
double contact_tolerance(const Vec3& x);

// The first time [s] up to `time_limit` at which a point outside the collider touches it while moving inwards; none if it
// does not.
std::optional<double> first_impact(const Collider& collider, double radius, const Parabola& path, double time_limit);

}  // namespace hooke
