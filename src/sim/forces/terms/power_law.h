#pragma once

#include "sim/portable_math.h"

namespace hooke {

// The integral of r^-power from a to b, both > 0.
inline double power_law_integral(double power, double a, double b) {
  return power == 1.0 ? portable::log(b / a) : (portable::pow(b, 1.0 - power) - portable::pow(a, 1.0 - power)) / (1.0 - power);
}

}  // namespace hooke
