// Runs whose accuracy is measured.
#pragma once

#include "lab/lab.h"
#include "support/test_sim.h"

namespace hooke {

inline Scene scene_of(const TestSim& sim, const Settings& settings) {
  Scene scene;
  scene.system = sim.system;
  scene.state = sim.state;
  scene.settings = settings;
  return scene;
}

// The accuracy of its frames is measured at once.
inline Lab measured_lab(const Scene& scene, AccuracyMode mode = AccuracyMode::Full) {
  Lab lab(scene, KeepStart::No);
  lab.submit(SetAccuracy{mode});
  return lab;
}

}  // namespace hooke
