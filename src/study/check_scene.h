// Runs a scene's own check (formats/scene_check.h) under every method that it lists.
#pragma once

#include <string>
#include <vector>

#include "formats/scene_check.h"

namespace hooke {

struct CheckResult {
  const Integrator* method = nullptr;
  bool passed = false;
  std::string measured;  // one line: each law with its figure
};

// Runs the scene from its state under every method. A law that speaks of what the scene has not, fails.
std::vector<CheckResult> check_scene(const Scene& scene);

}  // namespace hooke
