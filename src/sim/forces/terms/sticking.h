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

// A point is released at the end of the substep in which the pull on it exceeds the strength.
class Sticking {
 public:
  // Once a frame; a step never allocates.
  void begin_frame(Plan& plan, const Motion& motion);
  // Decides what is held from the positions, velocities and forces at the start of a step: what touches a plane, does not move away from it
  // and is pulled by at most the strength.
  void begin_step(Plan& plan, Motion& motion);
  // At the end of a step of h [s], contact included: adds the work of planes that move to that of colliders.
  void end_step(Plan& plan, double h, Motion& motion);

 private:
  void compute_pulls(Plan& plan, Motion& motion);

  Field f_;
  std::vector<StickyContact> none_, previous_;
  std::vector<double> pull_, start_pull_;  // [N], of each that is held, now and at the start of the step
};

}  // namespace hooke
