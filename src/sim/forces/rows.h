// One row per file of this folder, gathered by force_term.cpp in the order of the panel.
#pragma once

#include "sim/forces/force_term.h"

namespace hooke {

extern const ForceTerm wind_force;
extern const ForceTerm buoyancy_force;
extern const ForceTerm center_force;
extern const ForceTerm mass_center_force;
extern const ForceTerm wall_force;
extern const ForceTerm sticky_force;

}  // namespace hooke
