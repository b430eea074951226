// The same motion by independent solvers: SUNDIALS, with forces and their derivatives written from their definition, using only the lists
// of points and springs.
#pragma once

#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

enum class Oracle {
  Bdf,       // CVODE: multistep, implicit, order 1 to 5
  Explicit,  // ARKODE: Fehlberg's Runge-Kutta of order 8
  Implicit,  // ARKODE: Kvaerno's diagonally implicit Runge-Kutta of order 5
};

// The state after `seconds` of a scene that consists only of gravity, points, nails, springs and dashpots. The tolerance, [m] and [m/s],
// bounds the RMS local error over all components.
State ask_oracle(Oracle oracle, const System& system, const State& start, double seconds, double tolerance);

}  // namespace hooke
