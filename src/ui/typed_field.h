// A text field for a number that belongs to one item, or to several with possibly different values.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ui/panels.h"

namespace hooke {

// The range of typed values: far beyond the sliders, but still computable. [kg], [m], [N/m], [N s/m], [1], [m/s], [N]
namespace typed {
inline constexpr double min_mass = 1e-9, max_mass = 1e9, max_length = 1e6, max_stiffness = 1e12, max_damping = 1e9, max_strain = 1e6,
                        max_speed = 1e6, max_force = 1e12;
}

struct TypedField {
  std::string_view label, unit, description;
  double min = 0.0, max = 1.0;
  double value = 0.0;
  bool mixed = false;              // several different values; `value` is their mean
  std::string_view infinity_text;  // the word for infinity, as "never"; empty if infinity is not allowed
};

// Parses a number, or the word for infinity. Returns nothing if it is neither.
std::optional<double> number_typed(std::string_view text, std::string_view infinity_text = {});

// Returns the new value, clamped to the range, once it is confirmed by Enter, Tab or a click elsewhere; Esc discards it.
std::optional<double> typed_row(const TypedField& field, Panels& panels);
// The same without label and unit, of this width.
std::optional<double> typed_cell(const TypedField& field, float width, Panels& panels);

// A field for a text of this many lines; 0: of a single one. Returns true, and the new text, once it is confirmed.
bool text_field(std::string& text, float lines, Panels& panels);

}  // namespace hooke
