// Quantities of a scene by name: the columns of CSV files, and the quantities of scene checks.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/forces/energy/energy.h"
#include "sim/model/accuracy.h"

namespace hooke {

// Intermediate values of several quantities, computed once per state.
struct Measurement {
  const System& system;
  const State& state;
  Energy energy;
  Momentum momentum;
  double min_strain = 0.0, largest_strain = 0.0;  // [1], over all springs
  const Accuracy* accuracy = nullptr;             // null: not measured
};
Measurement measure(const System& system, const State& state, const Accuracy* accuracy = nullptr);

struct QuantityRow {
  enum class Of { Scene, Point, Spring };
  std::string_view name;  // for a point or spring followed by its number: "y5"
  std::string_view unit;
  Of of;
  std::string_view description;
  double (*read)(const Measurement& measurement, Index at);  // NaN: not known
  bool needs_accuracy = false;                               // of Measurement

  // Along z, or about x and y: constant in a flat scene.
  bool is_spatial() const { return name.ends_with("z") != name.starts_with("angular_"); }
};
std::span<const QuantityRow> quantity_rows();

struct Quantity {
  const QuantityRow* row = nullptr;
  Index at = 0;  // index of the point or spring

  std::string name() const;
  std::string heading() const;  // "y5 [m]"
  // The point or spring must exist.
  double of(const Measurement& measurement) const { return row->read(measurement, at); }
};

// The quantity of this name in a scene with these numbers of points and springs; none if it does not exist.
std::optional<Quantity> find_quantity(std::string_view name, Index points, Index springs);

// The names that there are, "x0 to x7", if `name` is that of a quantity of points or springs with the number of one that does not exist;
// for a scene without any, that it has none. Otherwise empty.
std::string names_in_range(std::string_view name, Index points, Index springs);

// Appends the quantities of a comma-separated list, "time, y5"; returns the first unknown name, or an empty string.
std::string parse_quantities(std::string_view list, Index points, Index springs, std::vector<Quantity>& quantities);

// "time [s],y5 [m]" and the values of a state, one line each; nothing for a value that is not known.
std::string csv_heading(std::span<const Quantity> quantities);
std::string csv_row(std::span<const Quantity> quantities, const System& system, const State& state, const Accuracy* accuracy = nullptr);

// "time, kinetic, ..., x<point>, ...": the names, for messages, with or without those of the accuracy and those of spatial scenes.
std::string quantity_names(bool with_accuracy = true, bool with_spatial = true);

}  // namespace hooke
