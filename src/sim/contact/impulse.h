// The impulse of a contact, with Coulomb friction.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/model/system.h"

namespace hooke {

// The sum of what sweeps have added and taken back [N s], on the first of two bodies.
struct ContactImpulse {
  double normal = 0.0;  // not negative
  Vec3 friction{0.0};   // across the normal, at most the coefficient times the above
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

}  // namespace hooke
