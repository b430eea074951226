// Which points sticky planes hold (terms/sticky.cpp) during a step, and when they are let go.
#pragma once

#include "sim/forces/motion.h"

namespace hooke {

// The unit normal of the plane.
const Vec3& normal_of(const Plan& plan, const StickyContact& contact);

// [N], with which the forces f pull the point off the plane, which may accelerate.
double pull_on(const Plan& plan, const StickyContact& contact, double time, const double* f);

// Moves the points that are held back onto their planes, with the velocity of these along the normal, at the end of a step: what a method
// does outside the forces, such as dashpots that are split off and springs as constraints, moves them by as much as these pull within the
// step. Points that move into their planes are left to contact. Adds the work to that of contact.
void keep_on_planes(const Plan& plan, double time, Motion& motion);

// A release is an event: the step in which the pull on a held point exceeds the strength is repeated up to there. So the order of a method
// is that without sticky planes, up to the fourth.
class Sticking {
 public:
  // Once a frame; a step never allocates.
  void begin_frame(Plan& plan, const Motion& motion);
  // Decides what is held from the positions, velocities and forces at the start of a step: what touches a plane, does not move away from it
  // and is pulled by at most the strength.
  void begin_step(Plan& plan, Motion& motion);
  // Of a step of h from (x0, v0) at `start` [s] that led to the motion, contact included: the time [s] since its start at which the first
  // point is let go, at most h; infinity: none is. Adds the work of planes that move to that of colliders.
  double time_of_release(Plan& plan, const Field& x0, const Field& v0, double start, double h, Motion& motion);
  // What is let go at that time is not held in the step that begins there, whatever rounding errors say: after the step that starts there
  // has been taken back, or after the one that ends there.
  void release_at_start() { released_.insert(released_.end(), candidates_.begin(), candidates_.end()); }
  void end_step(bool is_at_release);
  // Steps are repeated for a number of releases in a substep. Each further one is at the end of a step.
  void begin_substep() { releases_ = 0; }

 private:
  double excess(Plan& plan, double time, const Field& x, const Field& v, Motion& motion);
  double excess_at(Plan& plan, double t, Motion& motion);
  double time_beyond(Plan& plan, double& excess, double at_end, Motion& motion);
  void add_work(const Plan& plan, Motion& motion) const;

  // The step that is examined.
  const Field *x0_ = nullptr, *v0_ = nullptr;
  double start_ = 0.0, h_ = 0.0;
  Field x_, v_, f_;
  std::vector<StickyContact> none_, previous_, released_, candidates_;
  std::vector<double> pull_, start_pull_;  // [N], of each that is held
  int releases_ = 0;
};

}  // namespace hooke
