// A labeled number with a unit and a slider.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/bounds.h"
#include "ui/panels.h"

namespace hooke {

struct NumberField {
  std::string_view label, unit, description;
  double min = 0.0, max = 1.0, default_value = 0.0, value = 0.0;
  double step = 0.0;  // values are multiples of it; 0 for any value
  bool integer = false, logarithmic = false, enabled = true;
  bool mixed = false;             // the mean of several different values
  std::string_view zero_text{};   // shown for 0, as "never"; empty: the number
  std::optional<Bounds> typed{};  // the range of typed numbers, which may exceed that of the slider; none: that of the slider
};

// The field for a row of a table that has a label, a unit, a range and a default.
template <class Row>
NumberField field_of_row(const Row& row, double value) {
  const bool spans_decades = (row.min > 0.0 ? row.max >= 100.0 * row.min : row.min == 0.0 && row.max >= 1e5) && !row.integer;
  return {.label = row.label,
          .unit = row.unit,
          .description = {},
          .min = row.min,
          .max = row.max,
          .default_value = row.default_value,
          .value = value,
          .integer = row.integer,
          .logarithmic = spans_decades};
}

// "from 1 to 1000 N/m", "more than 0"
std::string bounds_text(const Bounds& range, std::string_view unit);

// The label on the left of a row; the next item is placed to its right.
void begin_row(const std::string& label);

struct NumberChange {
  double value;
  bool is_drag;  // not typed, nor reset
};

// Drag to change, Ctrl+click to type, right-click for the default. Returns the new value if it changed. A typed number
// counts when typing is finished, if it is allowed.
std::optional<NumberChange> changed_row(const NumberField& field, Panels& panels);
// The same, for a single value.
std::optional<double> number_row(const NumberField& field, Panels& panels);

}  // namespace hooke
