// A step that only `auto` takes: velocity Verlet with the forces of weak dashpots among those of the springs.
#pragma once

#include <string_view>

#include "sim/methods/integrator.h"

namespace hooke {

// Its row is not in the table of integrators: without dashpots it is velocity_verlet, and with them `auto` selects it where it pays.
extern const Integrator leapfrog;

// The method with this id that may be the choice of a frame: this one, or a row of the table; or null.
const Integrator* find_chosen_method(std::string_view id);

// Whether it differs from velocity_verlet, and no force but those of springs and dashpots depends on the velocities.
inline bool is_leapfrog_useful(const Plan& plan) { return plan.has_dashpots() && !plan.force_data.depend_on_velocity; }

// Whether the method splits the dashpots off, in two sweeps per step.
inline bool splits_dashpots(const Integrator& method) {
  return method.symplectic && method.order > 1 && method.implicit_solve == ImplicitSolve::None && &method != &leapfrog;
}

}  // namespace hooke
