// Why springs are longer than their rest length: what their load, the solver, the strain limit, the step and the motion contribute.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "sim/model/settings.h"
#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

// Mean strains of some springs [1]. The terms sum to `now`, except for step_error, which is part of `motion`.
struct StretchBreakdown {
  std::vector<SpringId> springs;
  double now = 0.0;
  std::optional<double> load;    // in the equilibrium under the weight, without the strain limit
  std::optional<double> limit;   // by which the limit makes it shorter; none: there is no limit
  std::optional<double> solver;  // by which the equilibrium of the method differs, because its iterations end before they have converged
  std::optional<double> motion;  // the rest: what moves, and what the hand, contact and other forces stretch
  // RMS difference within `seconds` [s] from now between this step and half of it
  std::optional<double> step_error;
  double seconds = 0.0;
  std::string why_no_load;  // in a clause; empty: it is known
};

// Runs copies from the equilibrium and from this state. `progress` is called between substeps; false ends it, with what is known so far.
StretchBreakdown explain_stretch(const System& system, const State& state, const Settings& settings, const std::vector<SpringId>& springs,
                                 const Progress& progress);

}  // namespace hooke
