// Steps within the linear stability limit of a method on a scene, and the warning about a longer one.
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

// The minimum number of substeps per frame within the linear stability limit of the method on this scene; none if no step is stable.
std::optional<int> min_stable_substeps(const Integrator& integrator, const Spectrum& spectrum, double frame_rate);

// The current method with enough substeps or, if none are enough, another method. Not tested on the scene (study/remedy/remedy.h).
// `margin`: recommended_margin of the state from which it runs.
Advice suggest_stepping(const Spectrum& spectrum, const Settings& settings, int margin = default_margin);

// A warning about a step beyond the linear limit of the method on this scene: "FIELD: VALUE: ...", with names of the scene file.
std::optional<std::string> step_warning(const System& system, const State& state, const Settings& settings);

// A warning about the fastest of the colliders whose oscillations are not resolved by the steps: "colliders[0].frequency: 240: ...".
std::optional<std::string> oscillation_warning(const System& system, const Settings& settings);

// A warning about a tolerance or a budget that the method does not use: "FIELD: VALUE: ...".
std::optional<std::string> unused_setting_warning(const Settings& settings);

// "Velocity Verlet with 80 substeps per frame"
std::string describe(const Advice& advice);

}  // namespace hooke
