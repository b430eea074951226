// Keeps the energy balance of a run, frame by frame.
#pragma once

#include "sim/accuracy.h"
#include "sim/motion.h"
#include "sim/system.h"

namespace hooke {

class EnergyAccounts {
 public:
  // Starts at this state with its energy [J].
  void start(const State& state, double energy);
  // The frame that led from `before` to `after`, whose energy is `energy` [J].
  void add_frame(const System& system, const State& before, const State& after, const Motion& motion, double energy);
  // The numerical gain [J] in a frame like those to come, from repeating one with half the step.
  void set_numerical_gain(double gain) { numerical_gain_ = gain; }

  const EnergyBalance& balance() const { return balance_; }

 private:
  EnergyBalance balance_;
  double start_ = 0.0, energy_ = 0.0;  // [J]
  double net_input_ = 0.0;             // [J], of the ledger after the last frame
  double numerical_gain_ = 0.0;        // [J] per frame
  double drag_share_ = 0.0;            // of what drag and dashpots dissipate together
  int frames_since_share_ = 0;         // since it was evaluated
};

}  // namespace hooke
