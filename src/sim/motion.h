// The State packed for stepping, in the Plan's layout. Lives for one frame; integrators read and write it.
#pragma once

#include "sim/plan.h"

namespace hooke {

struct Motion {
  double time = 0.0;
  Field x, v;                    // positions [m] and velocities [m/s]
  Field a;                       // accelerations [m/s^2] at (x, v), if acceleration_is_current
  bool acceleration_is_current = false;
  long force_evaluations = 0;    // since the frame began
  long factorizations = 0;
};

// An integrator's own scratch within a frame: sized and filled by its `prepare`; a step never allocates.
struct Workspace {
  std::vector<Field> fields;
};

// v = v e^(-c h) + a (1 - e^(-c h)) / c over `h` [s], a without drag: exact for constant a; v + h a when c = 0. A held
// point keeps the hand's velocity.
void kick(const Plan& plan, Motion& motion, double h);

// x = x + h v.
void drift(Motion& motion, double h);

// [m], [m/s] of every point into the packed layout and back.
void pack(const Plan& plan, const State& state, Motion& motion);
void unpack(const Plan& plan, const Motion& motion, State& state);

}  // namespace hooke
