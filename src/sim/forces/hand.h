// The force of the hand that acts in a frame, and its power.
#pragma once

#include "base/types.h"

namespace hooke {

struct Motion;
struct Plan;

// The force [N] of the hand: that of the spring of a pull, or the force that holds a held point against its springs and dashpots and,
// unless it is nailed, its weight. Zero without a grab.
Vec3 hand_force(const Plan& plan, const Motion& motion);

// The work of the hand from the construction on: by the trapezoidal rule for its power, but for what it stores by itself.
class HandWork {
 public:
  HandWork(const Plan& plan, const Motion& motion);
  // Adds it to the ledger, `h` [s] later. Sweeps over dashpots, which measure the kinetic energy of free points, have not counted as taken
  // what the hand did against them.
  void add(const Plan& plan, Motion& motion, double h, bool has_swept) const;

 private:
  double time_, power_, on_dashpots_, stored_;  // [s], [W], [W], [J], then
};

}  // namespace hooke
