// The unit in which methods that adapt their step measure an error.
#pragma once

#include "sim/forces/motion.h"

namespace hooke {

// Unit of the error [m], [m/s]: the tolerance, a velocity error counting by its effect within a second; at least the rounding
// error of coordinates and of forces.
struct ErrorScale {
  double position, velocity;
  ErrorScale(const Plan& plan, const Motion& motion, double tolerance);
  // [1]; 1: as large as the tolerance
  double relative(double position_error, double velocity_error) const;
};

}  // namespace hooke
