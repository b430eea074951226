// The watch over a run: is the new state a state at all, and has energy come from nowhere?
#pragma once

#include <optional>

#include "sim/energy.h"
#include "sim/settings.h"

namespace hooke {

// Why a frame was refused, and what broke first.
struct Divergence {
  enum class Kind { NotFinite, EnergyGain };
  Kind kind = Kind::NotFinite;
  double time = 0.0;               // [s], end of the refused frame
  double energy = 0.0;             // [J], beyond what was put in; not finite for NotFinite
  double scale = 0.0;              // [J], of what start, hand and edits put in
  std::optional<PointId> point;    // the fastest, or the first without a number
  std::optional<SpringId> spring;  // the one under the highest strain, on that point if it has any
};

// Energy may exceed what start, hand and edits put in by this many times their size.
inline constexpr double divergence_factor = 100.0;
// To this comes what the springs would hold if the hand's longest way in a step had stretched each of them (EnergyLedger): a
// step that takes a stiff sheet by a corner and turns it leaves it too long for a moment, and the books still say so.
// And it must be this share of the energy in motion and springs: a long fall gathers far more than what was put in, and
// with it a method's small share of error.
inline constexpr double divergence_fraction = 0.5;

// True when every position and velocity is a number.
bool is_finite(const State& state);

// Starts the books at this state: the ledger holds its energy.
void initialize_ledger(const System& system, State& state);

// Notes that an edit took the energy from `before` [J] to that of (system, state).
void record_edit_energy(const System& system, double before, State& state);

// Judges the frame that ended in `state`; none if it is sound.
std::optional<Divergence> find_divergence(const System& system, const State& state, const Energy& energy);

}  // namespace hooke
