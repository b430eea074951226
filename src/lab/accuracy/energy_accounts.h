// Keeps the energy balance of a run, frame by frame.
#pragma once

#include <optional>

#include "sim/forces/dashpots/dissipation_bound.h"
#include "sim/forces/motion.h"
#include "sim/model/accuracy.h"
#include "sim/model/system.h"

namespace hooke {

class EnergyAccounts {
 public:
  // Starts at this state with its energy [J].
  void start(const State& state, double energy);
  // The System was edited, so that its dissipation in the state after the last frame is another.
  void note_edit();
  // The frame that led from `before` to `after`, whose energy is `energy` [J]; `plan` is that of `system`, which still contains the springs
  // that broke in it.
  void add_frame(const Plan& plan, const System& system, const State& before, const State& after, const Motion& motion, double energy);
  // The last frame is repeated with half the step; afterwards, the numerical gain [J] in it.
  void begin_repetition() {
    repeated_rest_ = rest_;
    repeated_resolved_ = resolved_;
  }
  void set_numerical_gain(double gain);

  const EnergyBalance& balance() const { return balance_; }

 private:
  double dissipation_in(double rest, double max) const;

  EnergyBalance balance_;
  DissipationBound bound_;
  double start_ = 0.0, energy_ = 0.0;        // [J]
  double net_input_ = 0.0;                   // [J], of the ledger after the last frame
  double rest_ = 0.0, repeated_rest_ = 0.0;  // [J], of the last frame and the repeated one: by the method, drag and dashpots together
  double resolved_ = 0.0, repeated_resolved_ = 0.0;  // [J], likewise: by drag and dashpots, from their powers at both ends of the frame
  bool is_resolved_ = false;                         // whether these determine what is dissipated
  double gain_ratio_ = 0.0;                          // [1], of the gain of the method to the dissipation, which is negative
  double dissipation_ = 0.0;                         // [J], in the repeated frame
  struct Dissipation {
    double drag, dashpots;
  };
  std::optional<Dissipation> power_;  // [W], after the last frame
};

}  // namespace hooke
