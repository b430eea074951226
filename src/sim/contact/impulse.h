// The impulse of a contact, with Coulomb friction.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
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

// Sets the normal impulse, and opposes the slip [m/s] as far as friction can; `mass`: [kg], impulse per velocity. Returns the change of the
// whole impulse.
inline Vec3 change_impulse(ContactImpulse& impulse, double new_normal, const Vec3& normal, double friction, const Vec3& slip, double mass) {
  Vec3 total = (new_normal - impulse.normal) * normal;
  impulse.normal = new_normal;
  if (friction == 0.0) return total;
  const Vec3 before = impulse.friction;
  impulse.friction -= mass * slip;
  const double square = glm::dot(impulse.friction, impulse.friction), max = friction * impulse.normal;
  if (square > max * max) impulse.friction *= max / std::sqrt(square);
  return total + (impulse.friction - before);
}

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
