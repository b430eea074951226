// What changes from step to step, and all of it: nothing hidden survives a step outside this list.
#pragma once

#include <cstdint>
#include <vector>

#include "base/types.h"

namespace hooke {

// Where the energy came from; the watch for divergence compares the energy of the scene against it. [J]
struct EnergyLedger {
  double net_input = 0.0;     // net energy at the start, plus what the hand and edits added
  double scale = 0.0;         // sum of the sizes of those contributions
  double hand_stretch = 0.0;  // what the springs would hold, stretched each by the hand's longest way in a step so far
  bool operator==(const EnergyLedger&) const = default;
};

// What an adaptive method remembers from step to step. Zero: nothing yet.
struct MethodMemory {
  double step = 0.0;   // [s], the one it would take next
  double error = 0.0;  // [1], of its last step, relative to the tolerance
  bool operator==(const MethodMemory&) const = default;
};

struct State {
  double time = 0.0;           // [s]
  std::vector<Vec3> position;  // [m], one a point, in the System's order
  std::vector<Vec3> velocity;  // [m/s]
  Vec3 hand{0.0};              // [m], where the hand is now; meaningful while the System has a grab
  EnergyLedger ledger;
  MethodMemory memory;
  std::uint32_t torn = 0;  // which springs are broken: those of the so manieth tear of the run and of those before it; 0: none
  bool operator==(const State&) const = default;
};

}  // namespace hooke
