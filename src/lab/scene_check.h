// A scene's own check: laws that its motion keeps, written in its file (docs/scene-format.md), tried under every method that
// it lists.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lab/json_field.h"
#include "lab/scene.h"

namespace hooke {

struct LawKind;

// One law about one quantity over the run.
struct Law {
  const LawKind* kind = nullptr;
  std::string of;                       // the quantity's name (quantity.h)
  std::optional<double> value, within;  // in the quantity's unit; of a period [s]
  std::optional<double> least, most;
  double from = 0.0;  // [s] after the start: what was before does not count
};

// A method that the laws are tried under, with substeps of its own or as many as the scene has.
struct CheckedMethod {
  const Integrator* method = nullptr;
  std::optional<int> substeps;
};

struct SceneCheck {
  double seconds = 2.0;                // [s]
  std::vector<CheckedMethod> methods;  // none: the scene's own
  std::vector<Law> laws;               // besides that every state is finite
  bool stops = false;                  // it is there to be seen fail: the watch must stop it within `seconds`
};

// Throws Refused.
SceneCheck read_scene_check(const JsonField& field);

// What the scene's file asks for; without it two seconds of finite states.
SceneCheck check_of(const Scene& scene);

struct CheckResult {
  const Integrator* method = nullptr;
  bool passed = false;
  std::string measured;  // one line: each law with its figure
};

// Runs the scene from its state under every method. A law that speaks of what the scene has not, fails.
std::vector<CheckResult> check_scene(const Scene& scene);

}  // namespace hooke
