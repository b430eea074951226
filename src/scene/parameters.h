// The table of parameters: sliders, scene fields, `--set NAME=VALUE`, and entries of the manual and of docs/reference/scene-format.md
// follow from its rows.
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
  // What a write changes, and so what its inverse must store. Number and Setting: only the value that `read` returns; a Setting is not part
  // of the Plan and takes effect with the next frame. Structure: the Plan is made anew.
  enum class Scope { Number, Setting, Structure, Gravity, Colliders, SpringStiffness, SpringDamping, PointMass, PointSize };
  // The weight by which the k or d of each spring follows from the value.
  enum class Weight { One, InverseLength, Length, SheetWeight };
  std::string_view name;         // on the command line
  std::string_view field;        // in a scene file, dotted: "simulation.substeps"; empty: not a field of its own
  std::string_view group;        // heading on the panel; the rows of a group are consecutive
  std::string_view label;        // on the slider
  std::string_view unit;         // SI; empty: a pure number
  std::string_view description;  // one line for help and manual
  Kind kind = Kind::Number;
  double min = 0.0, max = 1.0, default_value = 0.0;  // the range of the slider
  Bounds physical{};                                 // the range in a scene file, and of `--set`, which may exceed that of the slider
  bool logarithmic = false;                          // the scale of the slider
  std::string_view zero_text{};                      // what 0 means, if not the number: "off"
  bool omit_if_default = false;                      // from files
  Scope scope = Scope::Number;
  // What it sets of springs: k or d, by a weight, and of a family or, without one, of all.
  struct Springs {
    double Spring::*property = nullptr;
    Weight weight = Weight::One;
    std::optional<SpringFamily> family{};
  };
  Springs springs{};
  double Collider::*collider = nullptr;           // what it sets of each collider
  std::span<const ParameterChoice> choices{};     // the value is an index of these
  bool (*applies)(const Scene& scene) = nullptr;  // whether the scene has what the row sets; null: always
  // The access to everything but springs and colliders. A value that may not be given, which `read` replaces by the default: whether it
  // is, and how it is removed; null: always given.
  struct Access {
    double (*read)(const Scene& scene) = nullptr;
    void (*write)(Scene& scene, double value) = nullptr;
    bool (*is_given)(const Scene& scene) = nullptr;
    void (*clear)(Scene& scene) = nullptr;
  };
  Access access{};

  bool is_number() const { return kind == Kind::Number || kind == Kind::Integer; }
  double read(const Scene& scene) const;
  void write(Scene& scene, double value) const;
  bool is_given(const Scene& scene) const { return access.is_given == nullptr || access.is_given(scene); }
};

std::span<const Parameter> parameters();

// The row of this name, or null.
const Parameter* find_parameter(std::string_view name);

// Gravity, wind, the settings of the simulation and every parameter that is not one of parts, from one scene to another.
void copy_surroundings(const Scene& from, Scene& to);

// Rows that other modules refer to.
extern const Parameter &dimensions_parameter, &substeps_parameter, &tolerance_parameter, &speed_parameter, &stiffness_parameter,
    &new_stiffness_parameter, &drag_parameter, &friction_parameter;

// The k or d of the spring divided by the value of the parameter; 0: the parameter does not set this spring. `sheet` may be null.
double weight_of(const Parameter& parameter, const SheetWeights* sheet, const Spring& spring);

// The single value shown for several: their common value, or their mean if they differ by more than rounding.
class CommonValue {
 public:
  void include(double value);
  double value_or(double none) const { return count_ == 0 ? none : is_uniform_ ? first_ : sum_ / static_cast<double>(count_); }
  bool is_mixed() const { return !is_uniform_; }
  bool is_empty() const { return count_ == 0; }

 private:
  double sum_ = 0.0, first_ = 0.0;
  long count_ = 0;
  bool is_uniform_ = true;
};

// The range that may be set: that of scene files or, where it is unlimited, that of the slider.
Bounds allowed_range(const Parameter& parameter);
// The value, rounded for integers; beyond that range, clamped to the slider. NaN becomes the default.
double clamp_to_range(const Parameter& parameter, double value);

}  // namespace hooke
