// Steps within the linear stability limit of a method on a scene, and the warning about a longer one.
#pragma once

#include <optional>
#include <string>

#include "sim/forces/passage.h"
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
// `margin`, `passage`: recommended_margin and shortest_passage of the state from which it runs.
Advice suggest_stepping(const Spectrum& spectrum, const Settings& settings, int margin = default_margin, const Passage& passage = {});

// The fewest substeps per frame with which the method resolves the passage, 1 without one; none if there are too many.
std::optional<int> resolving_substeps(const Passage& passage, const Integrator& integrator, double frame_rate);

// The fewest substeps per frame that are recommended with the current method; none if there are too many.
std::optional<int> recommended_substeps(const Spectrum& spectrum, const Settings& settings, int margin, const Passage& passage);

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
