// One row per file of this folder, gathered by integrator.cpp in the order of the menu.
#pragma once

#include "sim/integrator.h"

namespace hooke {

extern const Integrator explicit_euler;
extern const Integrator symplectic_euler;
extern const Integrator velocity_verlet;
extern const Integrator blanes_moan4;
extern const Integrator runge_kutta4;
extern const Integrator dop853;
extern const Integrator xpbd;
extern const Integrator implicit_euler;
extern const Integrator baraff_witkin;
extern const Integrator implicit_midpoint;
extern const Integrator tr_bdf2;
extern const Integrator esdirk4;

}  // namespace hooke
