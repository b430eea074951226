// The impulse of a contact: the one law of points, faces, springs and colliders.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "sim/contact/constants.h"
#include "sim/contact/gap.h"
#include "sim/plan/plan.h"

namespace hooke {

// The sum of what sweeps have added and taken back [N s], on the first of two bodies.
struct ContactImpulse {
  double normal = 0.0;  // not negative
  Vec3 friction{0.0};   // across the normal, at most the coefficient times the above
  Vec3 total(const Vec3& along) const { return normal * along + friction; }
  // For a start from what acted along another normal before.
  ContactImpulse scaled(double factor, const Vec3& along) const { return {factor * normal, factor * tangential(along, friction)}; }
};

// Two bodies that must not approach each other faster than a target, with Coulomb friction. What separates is pushed by no more than
// `max_push`; what approaches is stopped in any case.
struct ContactLaw {
  Vec3 normal{0.0};                                              // from the second to the first
  double mass = 0.0;                                             // [kg], impulse per relative velocity
  double friction = 0.0;                                         // [1]
  double target = 0.0;                                           // [m/s], the minimum relative velocity along the normal
  double max_push = std::numeric_limits<double>::infinity();     // [N s]
  double max_impulse = std::numeric_limits<double>::infinity();  // [N s]
  ContactImpulse impulse;                                        // so far

  // The change of the impulse at a velocity [m/s] of the first, as seen from the second: to the least that reaches the target, and against
  // the slip as far as friction can. A step of projected Gauss-Seidel.
  Vec3 solve(const Vec3& velocity) {
    const double along = glm::dot(normal, velocity), before = impulse.normal;
    if (before == 0.0 && !(along < target)) return Vec3(0.0);
    double next = before + (target - along) * mass;
    if (target > 0.0) next = std::min(next, std::max(max_push, before - along * mass));
    impulse.normal = std::clamp(next, 0.0, max_impulse);
    const Vec3 change = (impulse.normal - before) * normal;
    if (friction == 0.0) return change;
    const Vec3 opposed = impulse.friction;
    impulse.friction -= mass * (velocity - along * normal);
    const double square = glm::dot(impulse.friction, impulse.friction), max = friction * impulse.normal;
    if (square > max * max) impulse.friction *= max / std::sqrt(square);
    return change + (impulse.friction - opposed);
  }
};

// How overlaps of points and of surfaces are removed: by the velocity `rate` times the overlap [1/s], which is the bias of a soft
// constraint with frequency omega and damping ratio zeta (E. Catto, Box2D v3, b2MakeSoft), and by no more than the force of its spring,
// which accelerates by `stiffness` times the overlap [1/s^2]. Unlike there, what approaches is stopped by any force.
struct SoftConstraint {
  double rate = 0.0, stiffness = 0.0;
};
inline SoftConstraint soft_constraint(const SurfacePlan& plan, double h) {
  const double omega = 2.0 * std::numbers::pi * std::min(plan.frequency, contact::max_frequency / h);
  return {omega / (2.0 * plan.damping_ratio + h * omega), omega * omega};
}

}  // namespace hooke
