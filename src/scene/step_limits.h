// Steps within the linear stability limit of a method on a scene, and the warning about a longer one.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "sim/methods/integrator.h"
#include "sim/methods/passage_step.h"
#include "sim/model/settings.h"
#include "sim/model/system.h"

namespace hooke {

// A method and a number of substeps per frame.
struct Advice {
  const Integrator* integrator;
  int substeps;
  bool operator==(const Advice&) const = default;
};

// The minimum number of substeps per frame within the linear stability limit of the method on this scene; none if no step is stable.
std::optional<int> min_stable_substeps(const Integrator& integrator, const Spectrum& spectrum, double frame_rate);

// What steps have to resolve besides the linear limit.
struct StepNeeds {
  int margin = default_margin;                                   // below that limit (recommended_margin)
  Passage passage{};                                             // shortest_passage
  double oscillation = std::numeric_limits<double>::infinity();  // [s], the longest step that resolves the oscillations of colliders
};
// `state`: the one from which the scene runs.
StepNeeds step_needs(const System& system, const State& state);

// The current method with enough substeps or, if none are enough, another method. Not tested on the scene (study/remedy/remedy.h).
Advice suggest_stepping(const Spectrum& spectrum, const Settings& settings, const StepNeeds& needs = {});

// The fewest substeps per frame with which the method resolves passages and oscillations, 1 without any; none if there are too many.
std::optional<int> resolving_substeps(const StepNeeds& needs, const Integrator& integrator, double frame_rate);

// The fewest substeps per frame that are recommended with the current method; none if there are too many.
std::optional<int> recommended_substeps(const Spectrum& spectrum, const Settings& settings, const StepNeeds& needs);

// A warning about a step beyond the linear limit of the method on this scene, or too long for the passage of a point through the core of a
// force: "FIELD: VALUE: ...", with names of the scene file.
std::optional<std::string> step_warning(const System& system, const State& state, const Settings& settings);

// A warning about the fastest of the colliders whose oscillations are not resolved by the steps: "colliders[0].frequency: 240: ...".
std::optional<std::string> oscillation_warning(const System& system, const Settings& settings);

// A warning about a tolerance or a budget that the method does not use: "FIELD: VALUE: ...".
std::optional<std::string> unused_setting_warning(const Settings& settings);

// "Velocity Verlet with 80 substeps per frame"
std::string describe(const Advice& advice);

}  // namespace hooke
