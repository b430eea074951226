// The work of the listed forces, drag and dashpots, booked once per substep.
#pragma once

#include "sim/forces/motion.h"

namespace hooke {

// Where a force has a potential, its work is the difference of the potential, exact except for planes that move during the substep. For the
// rest the power is integrated by Simpson's rule along the cubic through both ends of the method's step. Where the step does not resolve
// the rate of the power, and where contact or the strain limit moved points afterwards, it is the power at the mean velocity of the substep
// (the displacement over h), and no more than is missing. Sweeps over dashpots report the kinetic energy that they take.
//
// Power instead of force times displacement, because a damping force that makes a step unstable still dissipates energy at every point of
// the step, so that the gain stays unexplained.
class PowerWork {
 public:
  // Call once per frame; a step never allocates. Drag and dashpots are measured on request: that costs about as much as a force evaluation
  // for each substep.
  void begin_frame(const Plan& plan, const Motion& motion, double velocity_lag, DashpotSweeps& sweeps, bool measures_damping);
  void begin_substep(const Plan& plan, const Motion& motion);
  // After the method's step of h and before anything else moves points.
  void end_step(const Plan& plan, Motion& motion, double h);
  // The same after several steps that lasted h together, from the power at both ends: by the trapezoidal rule, or, where h does not resolve
  // its rate, by its logarithmic mean, which is exact for exponential decay.
  void end_steps(const Plan& plan, Motion& motion, double h);
  // After the contact of points, whose work is that of impulses along the path of the method: sweeps act at the velocities between which
  // they lead, and contact has not done what they do more than that.
  void end_point_contact(const Plan& plan, double h, Motion& motion) const;
  // Adds the work since begin_substep to the ledger. `is_moved`: positions or velocities were changed after the method's step,
  // `is_limited`: by the strain limit too.
  void end_substep(const Plan& plan, Motion& motion, double h, bool is_moved, bool is_limited = false);
  // A step was taken back or springs broke: the power at its end is not that at the start of the next one.
  void forget_power() { is_power_current_ = false; }

 private:
  // `of_forces`: that of the listed forces, which some methods know.
  EnergyLedger power(const Plan& plan, double time, const Field& x, const Field& v, std::optional<double> of_forces = {}) const;
  EnergyLedger displacement_work(const Plan& plan, double h, const Field& end);
  void add_potential_work(const Plan& plan, Motion& motion, double h);
  void limit_to_missing(const Plan& plan, const Motion& motion, const EnergyLedger& unresolved);
  void find_impulses(const Plan& plan, const Motion& motion);
  double impulse_work_after(const Plan& plan, double h, const Field& end) const;
  double work_of_sweeps(const Plan& plan, double h, const Field& end) const;
  bool has_power() const { return has_forces_ || has_muscles_ || measures_drag_ || measures_dashpots_; }

  Field x_, v_;   // at the start of the substep
  Field free_x_;  // after the method's step, where dashpots were swept
  Field middle_x_, middle_v_;
  DashpotSweeps* sweeps_ = nullptr;  // of the method
  EnergyLedger power_;               // [W], at the end of the last step, if current
  EnergyLedger work_;                // [J], of the step
  bool is_power_current_ = false;
  double time_ = 0.0;     // [s], at the start of the substep
  double carried_ = 0.0;  // [J], that damping forces of the frame have taken beyond what was missing
  // Dashpots where contact may move points: their impulses in the method's step.
  struct Impulses {
    Field length, impulse;            // [m], [N s], per spring, at the end of the step
    double work = 0.0;                // [J]
    double part_after_contact = 1.0;  // of them
    bool replace_power = false;       // contact has moved points in the last substep, and is likely to do so in this one
  };
  Impulses impulses_;
  bool has_forces_ = false, has_muscles_ = false, has_potential_ = false, has_air_ = false;
  bool measures_drag_ = false, measures_dashpots_ = false;
};

}  // namespace hooke
