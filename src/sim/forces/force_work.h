// The work of the listed forces over a substep, for the energy balance.
#pragma once

#include "sim/motion.h"

namespace hooke {

// The part derived from a potential is exact, except for planes that move during the substep; for the rest, the power is integrated by
// Simpson's rule along the cubic through both ends of the substep. Power instead of force times displacement, because a damping force that
// makes a step unstable still dissipates energy at every point of the step, so that the gain stays unexplained. A substep that does
// not resolve the rate of the forces books the power of the mean velocity instead, which is exact for the steady motion that remains and
// never more than is dissipated.
class ForceWork {
 public:
  // Call once per frame; a step never allocates.
  void begin_frame(const Plan& plan, const Motion& motion);
  void begin_substep(const Plan& plan, const Motion& motion);
  // [J], since begin_substep.
  double end_substep(const Plan& plan, const Motion& motion, double h);

 private:
  Field x_, v_, middle_x_, middle_v_;
  double time_ = 0.0, power_ = 0.0;
};

}  // namespace hooke
