#include "lab/accuracy/energy_accounts.h"

namespace hooke {

void EnergyAccounts::start(const State& state, double energy) {
  balance_ = {.since = state.time};
  start_ = energy;
  net_input_ = state.supply.net_input;
}

void EnergyAccounts::add_frame(const Plan& plan, const State& before, const State& after, const Motion& motion, double energy) {
  // what was supplied before the frame contains the edits since the last one
  balance_.ledger.add(EnergyCause::Edits, before.supply.net_input - net_input_);
  balance_.ledger += explained(motion.energy, plan.hand.held || plan.collider_paths.any_moves);
  balance_.change = energy - start_;
  net_input_ = after.supply.net_input;
}

}  // namespace hooke
