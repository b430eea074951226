// What can be measured of a scene at a moment, by name: the columns of CSV files, and what scenes' checks speak of.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/energy.h"

namespace hooke {

// What several quantities are read from, computed once a moment.
struct Measurement {
  const System& system;
  const State& state;
  Energy energy;
  Momentum momentum;
  double min_strain = 0.0, largest_strain = 0.0;  // [1], over all springs
};
Measurement measure(const System& system, const State& state);

struct QuantityRow {
  enum class Of { Scene, Point, Spring };
  std::string_view name;  // of a point or spring followed by its number: "y5"
  std::string_view unit;
  Of of;
  std::string_view description;
  double (*read)(const Measurement& measurement, Index at);
};
std::span<const QuantityRow> quantity_rows();

struct Quantity {
  const QuantityRow* row = nullptr;
  Index at = 0;  // the point or spring, by its place in the scene

  std::string name() const;
  std::string heading() const;  // "y5 [m]"
  // The scene must still have that many points and springs.
  double of(const Measurement& measurement) const { return row->read(measurement, at); }
};

// The quantity of this name in a scene of so many points and springs; none: there is no such.
std::optional<Quantity> find_quantity(std::string_view name, Index points, Index springs);

// Appends those of a list with commas between, "time, y5"; returns the first name that is none, empty where all are.
std::string parse_quantities(std::string_view list, Index points, Index springs, std::vector<Quantity>& quantities);

// "time [s],y5 [m]" and the values at a moment, each a line.
std::string csv_heading(std::span<const Quantity> quantities);
std::string csv_row(std::span<const Quantity> quantities, const System& system, const State& state);

// "time, kinetic, ..., x0, y0, ...": the names, for messages.
std::string quantity_names();

}  // namespace hooke
