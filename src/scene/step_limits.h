// Steps within a method's linear stability limit on a scene, and the warning about a longer one.
#pragma once

#include <optional>
#include <string>

#include "sim/integrator.h"
#include "sim/settings.h"
#include "sim/system.h"

namespace hooke {

// A method and a number of substeps per frame.
struct Advice {
  const Integrator* integrator;
  int substeps;
  bool operator==(const Advice&) const = default;
};

// Fewest substeps per frame within the method's linear stability limit on this scene; none where no step is stable.
std::optional<int> min_stable_substeps(const Integrator& integrator, const Spectrum& spectrum, double frame_rate);

// The method as set with enough substeps or, where none are enough, another method. Not tested on the scene (study/remedy.h).
Advice suggest_stepping(const Spectrum& spectrum, const Settings& settings);

// A line for a step beyond the method's linear limit on this scene: "FIELD: VALUE: ...", in the words of a scene file.
std::optional<std::string> step_warning(const System& system, const Settings& settings);

// "Velocity Verlet with 80 substeps per frame"
std::string describe(const Advice& advice);

}  // namespace hooke
