// Keeps the energy balance of a run, frame by frame.
#pragma once

#include "sim/forces/motion.h"
#include "sim/model/accuracy.h"

namespace hooke {

class EnergyAccounts {
 public:
  // Starts at this state with its energy [J].
  void start(const State& state, double energy) {
    balance_ = {.since = state.time};
    start_ = energy;
    net_input_ = state.supply.net_input;
  }
  // The frame that led from `before` to `after`, whose energy is `energy` [J].
  void add_frame(const Plan& plan, const State& before, const State& after, const Motion& motion, double energy) {
    // what was supplied before the frame contains the edits since the last one
    balance_.ledger.add(EnergyCause::Edits, before.supply.net_input - net_input_);
    balance_.ledger += explained(motion.energy, plan.hand.held || plan.collider_paths.any_moves);
    balance_.change = energy - start_;
    net_input_ = after.supply.net_input;
  }

  const EnergyBalance& balance() const { return balance_; }

 private:
  EnergyBalance balance_;
  double start_ = 0.0;      // [J]
  double net_input_ = 0.0;  // [J], supplied up to the end of the last frame
};

}  // namespace hooke
