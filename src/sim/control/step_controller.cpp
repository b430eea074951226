#include "sim/control/step_controller.h"

#include <algorithm>
#include <cmath>

#include "base/file_limits.h"
#include "sim/control/constants.h"
#include "sim/model/portable_math.h"

namespace hooke {

double ratio_to_aim(double error, double share) { return error / (control::safety * share); }

bool is_accepted(double error, double share) { return ratio_to_aim(error, share) <= 1.0; }

int refined_substeps(const EstimatedFrame& frame, double share) {
  const double needed = std::isfinite(frame.error) ? portable::pow(ratio_to_aim(frame.error, share), 1.0 / frame.order) : 2.0;
  int growth = 2;
  while (growth < needed && growth < control::max_growth) growth *= 2;
  return frame.substeps > max_substeps / growth ? max_substeps : growth * frame.substeps;
}

int next_substeps(const EstimatedFrame& frame, double share) {
  // beyond these, the number changes by the most in any case
  constexpr double min = 1e-12, max = 1e12;
  const double p = frame.order, ratio = std::clamp(ratio_to_aim(frame.error, share), min, max);
  const double before = frame.ratio_before > 0.0 ? std::clamp(frame.ratio_before, min, max) : ratio;
  const double factor = portable::pow(ratio, control::integral_gain / p) * portable::pow(before, -control::proportional_gain / p);
  const double pairs = std::ceil(0.5 * frame.substeps * std::clamp(factor, 0.5, 2.0));
  return 2 * static_cast<int>(std::clamp(pairs, 1.0, 0.5 * max_substeps));
}

}  // namespace hooke
