// What was supplied to a scene so far (EnergySupply), which bounds what its motion can reach. The edits and the frames of a run add to it.
#pragma once

#include "sim/forces/energy/energy.h"
#include "sim/model/energy_ledger.h"
#include "sim/model/state.h"
#include "sim/plan/plan.h"

namespace hooke {

// Starts at this state, whose energy may be known.
void initialize_supply(const System& system, State& state);
void initialize_supply(const System& system, const Energy& energy, State& state);

// Records that an edit, which led to (system, state), changed the energy by `change` [J].
void record_edit_energy(const System& system, double change, State& state);

// What the hand does in a frame besides its work.
struct HandMotion {
  Vec3 target{0.0};                 // [m], of the grabbed point at the end of the frame
  Vec3 collider_displacement{0.0};  // [m], of the carried collider
  double speed = 0.0;               // [m/s], of both together
  double stretch = 0.0;             // [J], EnergySupply::hand_stretch of this frame
};

// Records the work of a frame that ended in `state`.
void record_frame_energy(const Plan& plan, const EnergyLedger& frame, const HandMotion& hand, State& state);

// [m] or [m/s], the maximum of the lengths.
double max_length(const std::vector<Vec3>& vectors);
double mass_of(const System& system);

}  // namespace hooke
