#include "sim/methods/error_scale.h"

#include <algorithm>
#include <cmath>

#include "sim/methods/constants.h"

namespace hooke {

ErrorScale::ErrorScale(const Plan& plan, const Motion& motion, double tolerance) {
  double max_coordinate = 0.0;
  for (const double x : motion.x) max_coordinate = std::max(max_coordinate, std::abs(x));
  position = std::max(tolerance, error_round_off * max_coordinate);
  velocity = std::max(tolerance, error_round_off * max_coordinate * (plan.spectrum.omega + plan.spectrum.dashpot_rate));
}

double ErrorScale::relative(double position_error, double velocity_error) const {
  const double x = position_error / position, v = velocity_error / velocity;
  return std::sqrt(x * x + v * v);
}

}  // namespace hooke
