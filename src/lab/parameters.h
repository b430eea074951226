// The table of parameters: from a row follow a slider, a scene field, `--set NAME=VALUE` and a line of the manual.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "lab/bounds.h"
#include "lab/scene.h"

namespace hooke {

struct Parameter {
  enum class Kind { Number, Whole, Switch };
  // What a write changes, and so what its inverse must hold; Number: the one number that `read` gives.
  enum class Scope { Number, Gravity, Colliders, SpringStiffness, SpringDamping };
  std::string_view name;     // on the command line
  std::string_view field;    // in a scene file, dotted: "simulation.substeps"; empty: not a field of its own
  std::string_view group;    // heading on the panel; rows of a group stand together
  std::string_view label;    // on the slider
  std::string_view unit;     // SI; empty: a pure number
  std::string_view meaning;  // one line for help and manual
  Kind kind = Kind::Number;
  double least = 0.0, most = 1.0, usual = 0.0;  // the range of the slider and of `--set`
  Bounds physical{};                            // what a scene file may hold: numbers beyond the slider's range as well
  bool logarithmic = false;                     // the slider's scale
  Scope scope = Scope::Number;
  std::optional<SpringFamily> family{};           // the springs that it sets; none: all
  bool (*applies)(const Scene& scene) = nullptr;  // whether the scene has what the row sets; null: every scene has
  double (*read)(const Scene& scene) = nullptr;
  void (*write)(Scene& scene, double value) = nullptr;
};

std::span<const Parameter> parameters();

// The row of this name, or null.
const Parameter* find_parameter(std::string_view name);

// Within the row's range; whole where the row says so. NaN becomes the usual value.
double clamp_to(const Parameter& parameter, double value);

}  // namespace hooke
