// The table of forces that a scene may have besides gravity, springs, dashpots, drag and the hand. Adding one is one file
// under force_terms/ and one row in force_term.cpp: its scene field, its panel and its manual follow from the row.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "base/table.h"

namespace hooke {

struct Plan;

// A number by which a force is set.
struct ForceParameter {
  std::string_view name;   // in files
  std::string_view label;  // on the slider
  std::string_view unit;
  double min, max, default_value;
};

inline constexpr std::size_t max_force_parameters = 8;
using ForceValues = std::array<double, max_force_parameters>;  // as many as the row has, in its order

struct ForceTerm {
  std::string_view id;           // in files
  std::string_view label;        // in the panel
  std::string_view description;  // one sentence
  std::span<const ForceParameter> numbers;
  // Adds the force [N] to f at `time` [s], positions x [m] and velocities v [m/s], all in the Plan's layout. `f` already
  // holds all forces that do not stand in this table, and those of the rows above.
  void (*add)(const Plan& plan, const ForceValues& values, double time, const double* x, const double* v, double* f);
};

Table<ForceTerm> force_terms();

// The row with this id, or null.
const ForceTerm* find_force_term(std::string_view id);

// The usual value of every number.
ForceValues default_values(const ForceTerm& term);

// A force as a scene has it.
struct Force {
  const ForceTerm* term = nullptr;
  bool on = true;
  ForceValues values{};
  bool operator==(const Force&) const = default;
};

}  // namespace hooke
