// A point that hangs from another.
#pragma once

#include "scene/scene.h"
#include "support/modifiers.h"
#include "support/trial.h"

namespace hooke {

inline Scene hanging(int dimensions = 2) {
  Trial trial;
  const PointId nail = trial.nail({0.0, 0.5, 0.0}), other = trial.nail({0.5, 0.5, 0.0}), bob = trial.add({0.2, 0.0, 0.0});
  trial.join(nail, bob, 100.0, 0.5);
  trial.join(other, bob, 100.0, 0.5);
  Scene scene;
  scene.name = "Hanging";
  scene.system = trial.system;
  scene.system.dimensions = dimensions;
  scene.state = trial.state;
  return scene;
}

}  // namespace hooke
