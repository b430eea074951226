// The settings of runs beside a run, and their names.
#pragma once

#include "lab/accuracy/companion.h"

namespace hooke {

// With these settings, named after them: "Velocity Verlet, 80 substeps".
Companion companion_of(const Settings& settings);

// Dormand-Prince 8 with a tolerance of 1e-9 of the size of the scene.
Companion reference_companion(const State& state, const Settings& settings);

}  // namespace hooke
