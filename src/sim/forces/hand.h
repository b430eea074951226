// The force of the hand that acts in a frame, and its power.
#pragma once

#include "base/types.h"

namespace hooke {

struct Motion;
struct Plan;

// The force [N] of the hand: that of the spring of a pull, or the force that holds a held point against its springs and dashpots and,
// unless it is nailed, its weight. Zero without a grab.
Vec3 hand_force(const Plan& plan, const Motion& motion);
// The energy [J] of the springs between a held point and points that do not move, with the rest lengths at this time: only the hand
// changes it.
double energy_of_hand_alone(const Plan& plan, double time, const Motion& motion);
// The power [W] of the force of the hand, without what it does to those.
double hand_power(const Plan& plan, const Motion& motion);

// The work of the hand from the construction on: by the trapezoidal rule for its power, but for what it stores by itself.
class HandWork {
 public:
  HandWork(const Plan& plan, const Motion& motion);
  // Adds it to the ledger, `h` [s] later.
  void add(const Plan& plan, Motion& motion, double h) const;

 private:
  double time_, power_, stored_;  // [s], [W], [J], then
};

}  // namespace hooke
