// The same motion by somebody else's solvers: SUNDIALS, with forces and their derivatives written from their definition
// and from nothing but the lists of points and springs.
#pragma once

#include "sim/state.h"
#include "sim/system.h"

namespace hooke {

enum class Oracle {
  Bdf,       // CVODE: multistep, implicit, order 1 to 5
  Explicit,  // ARKODE: Fehlberg's Runge-Kutta of order 8
  Implicit,  // ARKODE: Kvaerno's diagonally implicit Runge-Kutta of order 5
};

// What `seconds` make of the scene, which must be gravity, points, nails, springs and dashpots and nothing else. The
// tolerance [m], and [m/s] for velocities, is what the solver allows its local error, RMS over all components.
State ask_oracle(Oracle oracle, const System& system, const State& start, double seconds, double tolerance);

}  // namespace hooke
