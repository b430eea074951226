// The change of a velocity by a constant acceleration and drag.
#pragma once

#include "sim/model/portable_math.h"

namespace hooke {

// v' = decay v + weight a: exact over h [s] for constant a, with drag c [1/s]: decay = e^(-c h), weight = (1 - e^(-c h)) / c, or 1 and h.
template <class T>
struct Kick {
  T decay = 1, weight = 0;  // [1], [s]
};

inline Kick<double> kick_over(double drag, double h) {
  if (drag == 0.0) return {1.0, h};
  return {portable::exp(-drag * h), -portable::expm1(-drag * h) / drag};
}

}  // namespace hooke
