// A scene's own check: the laws that its motion keeps, written in its file (docs/scene-format.md), and the methods that it lists.
#pragma once

#include <optional>
#include <vector>

#include "base/json_field.h"
#include "scene/law.h"
#include "scene/scene.h"

namespace hooke {

// A method that the laws are tried under, with substeps of its own or as many as the scene has.
struct CheckedMethod {
  const Integrator* method = nullptr;
  std::optional<int> substeps;
};

struct SceneCheck {
  double seconds = 2.0;                // [s]
  std::vector<CheckedMethod> methods;  // none: the scene's own
  std::vector<Criterion> criteria;     // besides that every state is finite
  bool expects_divergence = false;     // it is there to be seen fail: the watch must stop it within `seconds`
};

// Throws InputError.
SceneCheck read_scene_check(const JsonField& field);

// What the scene's file asks for; without it two seconds of finite states.
SceneCheck check_of(const Scene& scene);

}  // namespace hooke
