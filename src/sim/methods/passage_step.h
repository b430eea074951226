// The steps that resolve the passage of points through the small regions in which listed forces are strongest.
#pragma once

#include <limits>

#include "sim/forces/passage.h"
#include "sim/methods/integrator.h"

namespace hooke {

// The one that takes the shortest steps of all points that are not nailed, of those that may begin within so many seconds.
Passage shortest_passage(const System& system, const State& state, double within = std::numeric_limits<double>::infinity());

// [s], the longest step with which the method gets the point through with an energy that is wrong by less than about a hundredth of that of
// its motion far from there. Infinity: there is no passage, or the method adapts its step.
double longest_step(const Passage& passage, const Integrator& integrator);

}  // namespace hooke
