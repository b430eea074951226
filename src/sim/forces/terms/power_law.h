#pragma once

#include <cmath>

#include "sim/model/force_term.h"
#include "sim/model/portable_math.h"

namespace hooke {

// The integral of r^-power to r > 0: from infinity for a power above 1, because that from a small core is so large that differences between
// distant points would be lost in rounding; else from the core radius.
inline double power_law_potential(double power, double core, double r) {
  if (power == 1.0) return portable::log(r / core);
  const double from_core = power > 1.0 ? 0.0 : portable::pow(core, 1.0 - power);
  return (portable::pow(r, 1.0 - power) - from_core) / (1.0 - power);
}

// Of the attraction to so many centers. Powers that are not integers take a logarithm and an exponential each.
inline ForceCost cost_of_power_law(double power, double centers) {
  const bool is_integer = power == std::floor(power);
  return {.evaluation = (is_integer ? 2.0 : 16.0) * centers, .energy = (is_integer ? 9.0 : 31.0) * centers};
}

}  // namespace hooke
