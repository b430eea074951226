// Advice on the step of a scene, and warnings about steps that are too long for it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/methods/step_limits.h"
#include "sim/model/settings.h"
#include "sim/model/system.h"

namespace hooke {

// A method and a number of substeps per frame.
struct Advice {
  const Integrator* integrator;
  int substeps;
  bool operator==(const Advice&) const = default;
};

// The current method with enough substeps or, if none are enough, another method. Not tested on the scene (study/remedy/remedy.h).
Advice suggest_stepping(const StepLimits& limits, const Settings& settings);

// A warning about a step beyond the linear limit of the method on this scene, or too long for the passage of a point through the core of a
// force: "FIELD: VALUE: ...", with names of the scene file.
std::optional<std::string> step_warning(const System& system, const State& state, const Settings& settings);

// A warning about the fastest of the oscillations of colliders and muscles that the steps do not resolve: "colliders[0].frequency: 240:
// ...".
std::optional<std::string> oscillation_warning(const System& system, const Settings& settings);

// A warning about a tolerance or a budget that the method does not use: "FIELD: VALUE: ...".
std::optional<std::string> unused_setting_warning(const Settings& settings);

// All of these.
std::vector<std::string> settings_warnings(const System& system, const State& state, const Settings& settings);

// "Velocity Verlet with 80 substeps per frame"
std::string describe(const Advice& advice);

}  // namespace hooke
