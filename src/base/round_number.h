#pragma once

#include <cmath>

namespace hooke {

// The greatest of 1, 2 and 5 x 10^n that is not above a positive number.
inline double round_below(double number) {
  const double decade = std::pow(10.0, std::floor(std::log10(number)));
  return decade * (number >= 5.0 * decade ? 5.0 : number >= 2.0 * decade ? 2.0 : 1.0);
}

}  // namespace hooke
