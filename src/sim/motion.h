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

// Calls visit(i, w) for every component i of a Field, w the inverse mass [1/kg] of the component's point.
template <class Visit>
void for_each_component(const Plan& plan, Visit visit) {
  const auto n = static_cast<std::size_t>(plan.points);
  const double* inverse_mass = plan.inverse_mass.data();
  for (std::size_t begin = 0; begin < n * plan.dimensions; begin += n)
    for (std::size_t i = 0; i < n; ++i) visit(begin + i, inverse_mass[i]);
}

// [m], [m/s] of every point into the packed layout and back.
void pack(const Plan& plan, const State& state, Motion& motion);
void unpack(const Plan& plan, const Motion& motion, State& state);

}  // namespace hooke
