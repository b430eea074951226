// The table of parameters: from a row follow a slider, a scene field, `--set NAME=VALUE` and a line of the manual.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "base/bounds.h"
#include "scene/scene.h"

namespace hooke {

// One of the values of a row that is neither a number nor a switch.
struct ParameterChoice {
  std::string_view id;           // in files and on the command line
  std::string_view label;        // on the panel
  std::string_view description;  // one line
};

struct Parameter {
  enum class Kind { Number, Integer, Switch, Choice };
  // What a write changes, and so what its inverse must hold. Number and Setting: the one number that `read` gives; a Setting is not part
  // of the Plan, it takes effect with the next frame.
  enum class Scope { Number, Setting, Gravity, Colliders, SpringStiffness, SpringDamping, PointMass, PointSize };
  // What k or d of each spring is of the value.
  enum class Weight { One, InverseLength, Length, SheetWeight };
  std::string_view name;         // on the command line
  std::string_view field;        // in a scene file, dotted: "simulation.substeps"; empty: not a field of its own
  std::string_view group;        // heading on the panel; rows of a group stand together
  std::string_view label;        // on the slider
  std::string_view unit;         // SI; empty: a pure number
  std::string_view description;  // one line for help and manual
  Kind kind = Kind::Number;
  double min = 0.0, max = 1.0, default_value = 0.0;  // the range of the slider and of `--set`
  Bounds physical{};                                 // what a scene file may hold: numbers beyond the slider's range as well
  bool logarithmic = false;                          // the slider's scale
  bool omit_if_default = false;                      // from a file that would hold the usual value
  Scope scope = Scope::Number;
  std::optional<SpringFamily> family{};           // the springs that it sets; none: all
  Weight weight = Weight::One;                    // of those springs
  std::span<const ParameterChoice> choices{};     // the value is the place of one
  bool (*applies)(const Scene& scene) = nullptr;  // whether the scene has what the row sets; null: every scene has
  double (*read)(const Scene& scene) = nullptr;
  void (*write)(Scene& scene, double value) = nullptr;
};

std::span<const Parameter> parameters();

// The row of this name, or null.
const Parameter* find_parameter(std::string_view name);

// What the spring's k or d is of the value, in the dimension that the row says; 0: the row is not about it. `sheet` may be null.
double weight_of(const Parameter& parameter, const SheetWeights* sheet, const Spring& spring);

// The one value shown for many: theirs, or where they differ by more than rounding, their mean.
class CommonValue {
 public:
  void include(double value);
  double value_or(double none) const { return count_ == 0 ? none : is_uniform_ ? first_ : sum_ / static_cast<double>(count_); }
  bool is_mixed() const { return !is_uniform_; }

 private:
  double sum_ = 0.0, first_ = 0.0;
  long count_ = 0;
  bool is_uniform_ = true;
};

// Within the row's range; whole where the row says so. NaN becomes the usual value.
double clamp_to(const Parameter& parameter, double value);

}  // namespace hooke
