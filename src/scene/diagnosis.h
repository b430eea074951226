// Says in words why a run stopped and what would have held.
#pragma once

#include <optional>
#include <string>

#include "sim/divergence.h"
#include "sim/integrator.h"
#include "sim/settings.h"
#include "sim/system.h"

namespace hooke {

// A method and a number of substeps that hold.
struct Advice {
  const Integrator* integrator;
  int substeps;
};

// Fewest substeps per frame at which the method's own limit holds on this scene; none where no step holds.
std::optional<int> min_stable_substeps(const Integrator& integrator, const Spectrum& spectrum, double frame_rate);

// The method as set with enough substeps, or, where that does not help, another one.
Advice advise(const Spectrum& spectrum, const Settings& settings);

// A line that says so when the step as set is beyond the method's limit on this scene, and what would be stable: "FIELD:
// VALUE: ...", in the words of a scene file.
std::optional<std::string> step_warning(const System& system, const Settings& settings);

// One or two sentences that name the point and the spring (by their numbers in the list, from 0) and the advice.
std::string explain(const Divergence& divergence, const System& system, const Settings& settings, const Advice& advice);

}  // namespace hooke
