// A test system as a 2-D scene.
#pragma once

#include <string>

#include "scene/scene.h"
#include "support/test_sim.h"

namespace hooke {

inline Scene flat_scene(std::string name, const TestSim& sim) {
  Scene scene;
  scene.name = std::move(name);
  scene.system = sim.system;
  scene.system.dimensions = 2;
  scene.state = sim.state;
  return scene;
}

}  // namespace hooke
