// A point that hangs from another.
#pragma once

#include "scene/scene.h"
#include "support/modifiers.h"
#include "support/test_sim.h"

namespace hooke {

inline Scene hanging(int dimensions = 2) {
  TestSim sim;
  const PointId nail = sim.nail({0.0, 0.5, 0.0}), other = sim.nail({0.5, 0.5, 0.0}), bob = sim.add({0.2, 0.0, 0.0});
  sim.join(nail, bob, 100.0, 0.5);
  sim.join(other, bob, 100.0, 0.5);
  Scene scene;
  scene.name = "Hanging";
  scene.system = sim.system;
  scene.system.dimensions = dimensions;
  scene.state = sim.state;
  return scene;
}

}  // namespace hooke
