#pragma once

#include <cmath>

namespace hooke {

// The integral of r^-power from a to b, both > 0.
inline double power_law_integral(double power, double a, double b) {
  return power == 1.0 ? std::log(b / a) : (std::pow(b, 1.0 - power) - std::pow(a, 1.0 - power)) / (1.0 - power);
}

}  // namespace hooke
