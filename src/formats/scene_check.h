// The check of a scene: criteria for its motion and the methods to test, given in its file (docs/reference/scene-format.md).
#pragma once

#include <optional>
#include <vector>

#include "base/json_field.h"
#include "scene/law.h"
#include "scene/scene.h"

namespace hooke {

// A method to test, with its own substeps or those of the scene.
struct CheckedMethod {
  const Integrator* method = nullptr;
  std::optional<int> substeps;
};

struct SceneCheck {
  double seconds = 2.0;                // [s]
  std::vector<CheckedMethod> methods;  // none: that of the scene
  std::vector<Criterion> criteria;     // in addition, every state must be finite
  bool expects_divergence = false;     // the run must be stopped as divergent within `seconds`
};

// Throws InputError.
SceneCheck read_scene_check(const JsonField& field);

// The check in the file of the scene; by default two seconds of finite states.
SceneCheck check_of(const Scene& scene);

}  // namespace hooke
