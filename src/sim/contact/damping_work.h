// What drag and dashpots dissipate in each substep of a scene in which contact of points, springs and faces, or the strain limit, may take
// back velocities on which they have acted in the same substep: there, the velocities at the ends of a frame do not show it.
#pragma once

#include "sim/forces/motion.h"

namespace hooke {

class DampingWork {
 public:
  // Call in this order, once per frame and in each substep; a step never allocates.
  void begin_frame(const Plan& plan, double velocity_lag, Motion& motion, Workspace& work);
  void begin_substep(const Plan& plan, const Motion& motion, Workspace& work);
  // After the step of the method.
  void end_step(const Plan& plan, const Motion& motion);
  // After contact with colliders and between points, whose work is that of the mean acceleration of the step over the path of each point.
  void end_point_contact(const Plan& plan, double h, Motion& motion);
  // After all contact and the strain limit, which has acted if `is_limited`. Adds to motion.drag_work and motion.dashpot_work.
  void end_substep(const Plan& plan, double h, bool is_limited, Motion& motion);

 private:
  // [J], of the dashpots in the substep. `end`: where contact has led; none: it has not acted on its own.
  double work_of_sweeps(const Plan& plan, double h, const Motion* end) const;
  double work_of_forces(const Plan& plan, double h, const Motion* end) const;

  bool is_measured_ = false;
  double velocity_lag_ = 0.0;              // [1], of the method (integrator.h)
  const DashpotSweeps* sweeps_ = nullptr;  // of the method
  Field x_, v_;                            // at the start of the substep
  Field free_x_, free_v_;                  // after the step of the method
  double start_ = 0.0;                     // [s]
  // [J], of the motion before the substep
  double contact_work_ = 0.0, limit_work_ = 0.0, dashpot_work_ = 0.0;
};

}  // namespace hooke
