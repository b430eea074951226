// Runs the check of a scene (formats/scene_check.h) with every method that it lists.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "formats/scene_check.h"

namespace hooke {

struct CheckResult {
  const Integrator* method = nullptr;
  bool passed = false;
  std::string measured;  // one line: each criterion with its figure
};

// Runs the scene from its state with every method of the check. A criterion about a missing item fails. `after_substep` may throw.
std::vector<CheckResult> run_check(const SceneCheck& check, const Scene& scene, const std::function<void()>& after_substep = {});
// The same with the check of the scene.
std::vector<CheckResult> check_scene(const Scene& scene, const std::function<void()>& after_substep = {});

}  // namespace hooke
