// Detects that a run diverged: a state that is not finite, an unexplained gain of energy, points implausibly far away, an adaptive
// method that finds no step, or too many pairs of points within reach of each other.
#pragma once

#include <optional>

#include "sim/forces/energy/energy.h"
#include "sim/model/settings.h"
#include "sim/step/step.h"
#include "sim/step/supply.h"

namespace hooke {

// Why a frame was rejected, and what diverged first.
struct Divergence {
  enum class Kind { NotFinite, EnergyGain, Implausible, StepTooShort, TooManySteps, TooManyPairs, MatrixTooLarge };
  Kind kind = Kind::NotFinite;
  double time = 0.0;               // [s], end of the rejected frame
  double energy = 0.0;             // [J], beyond what was supplied; not finite for NotFinite
  double scale = 0.0;              // [J], of what start, hand, edits and forces supplied
  double distance = 0.0;           // [m], of the farthest point from the origin
  std::optional<PointId> point;    // the fastest; of points that are not finite, the one with the stiffest springs for its mass
  std::optional<SpringId> spring;  // the one under the highest strain, on that point if it has any
};

// True when every position and velocity is finite.
bool is_finite(const State& state);

// Checks the frame that ended in `state`, or before its end with a `failure`; none if it did not diverge. The gain of energy beyond what
// was supplied is compared with divergence_factor times the supply and its hand_stretch: in a step in which the hand turns a stiff sheet at
// its corner, springs are briefly too long.
std::optional<Divergence> find_divergence(const System& system, const State& state, const Energy& energy,
                                          StepFailure failure = StepFailure::None);

}  // namespace hooke
