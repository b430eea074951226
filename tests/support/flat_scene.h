// A trial as a 2-D scene.
#pragma once

#include <string>

#include "scene/scene.h"
#include "support/trial.h"

namespace hooke {

inline Scene flat_scene(std::string name, const Trial& trial) {
  Scene scene;
  scene.name = std::move(name);
  scene.system = trial.system;
  scene.system.dimensions = 2;
  scene.state = trial.state;
  return scene;
}

}  // namespace hooke
