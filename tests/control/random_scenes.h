// Scenes that nobody chose, for claims about the method `auto`: a number makes one.
#pragma once

#include <string_view>

#include "support/test_sim.h"

namespace hooke {

struct RandomScene {
  std::string_view kind;
  TestSim sim;
  double tolerance = 1e-3;  // [m/s]
};

// Kinds in turn: net, rope, orbit, cloth, contact, wind, breaking.
RandomScene make_random_scene(unsigned long seed, int number);

}  // namespace hooke
