// Rounding of the velocities that contact derives from positions.
#pragma once

#include <glm/geometric.hpp>
#include <limits>

#include "sim/plan/plan.h"

namespace hooke {

// The correction [m/s] of a velocity by the difference of two positions about `x`, h [s] apart; zero where it is rounding. Impacts on a
// collider that oscillates may need steps so short that their difference has lost most of its digits.
inline Vec3 without_rounding(const Plan& plan, const Vec3& correction, const Vec3& x, double h) {
  if (plan.collider_paths.resolving_step == std::numeric_limits<double>::infinity()) return correction;
  constexpr double units = 4.0;
  const double rounding = units * std::numeric_limits<double>::epsilon() * glm::length(x) / h;
  return glm::length(correction) <= rounding ? Vec3(0.0) : correction;
}

}  // namespace hooke
