// The work of the listed forces over a substep, for the energy balance.
#pragma once

#include "sim/forces/motion.h"

namespace hooke {

// The part derived from a potential is exact, except for planes that move during the substep; for the rest, the power is integrated by
// Simpson's rule along the cubic through both ends of the substep. Power instead of force times displacement, because a damping force that
// makes a step unstable still dissipates energy at every point of the step, so that the gain stays unexplained. A substep that does
// not resolve the rate of the forces records the power of the mean velocity instead, which is exact for the steady motion that remains and
// never more than is dissipated.
class ForceWork {
 public:
  // Call once per frame; a step never allocates.
  void begin_frame(const Plan& plan, const Motion& motion);
  void begin_substep(const Plan& plan, const Motion& motion);
  // Integrates the power over the substep. Call it before contact or the strain limit move points, whose
  // displacements are not the motion along which the forces work.
  void integrate_power(const Plan& plan, Motion& motion, double h);
  // Adds the work since begin_substep to that of the motion. `is_moved`: positions or velocities were changed after integrate_power.
  void end_substep(const Plan& plan, Motion& motion, double h, bool is_moved);

  // What a substep leaves for the next one; restored where a step is taken back.
  struct Memory {
    double power = 0.0;  // [W], at the end of the substep, if current
    bool power_is_current = false;
    double carried = 0.0;  // [J], work of earlier substeps of the frame that was more than was missing then
  };
  const Memory& memory() const { return memory_; }
  void restore(const Memory& memory) { memory_ = memory; }

 private:
  double energy_change(const Plan& plan, const Motion& motion) const;

  Field x_, v_, middle_x_, middle_v_;
  Memory memory_;
  double time_ = 0.0, power_work_ = 0.0;
  bool has_power_ = false, has_potential_ = false;
  bool is_alone_ = false;  // whether nothing but the listed forces supplies energy to the motion
};

}  // namespace hooke
