#pragma once

#include "sim/portable_math.h"

namespace hooke {

// The integral of r^-power to r > 0: from infinity for a power above 1, because that from a small core is so large that differences between
// distant points would be lost in rounding; else from the core radius.
inline double power_law_potential(double power, double core, double r) {
  if (power == 1.0) return portable::log(r / core);
  const double from_core = power > 1.0 ? 0.0 : portable::pow(core, 1.0 - power);
  return (portable::pow(r, 1.0 - power) - from_core) / (1.0 - power);
}

}  // namespace hooke
