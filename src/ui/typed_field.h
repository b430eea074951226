// A number to be typed, of one thing or of several that may differ.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ui/panels.h"

namespace hooke {

struct TypedField {
  std::string_view label, unit, description;
  double min = 0.0, max = 1.0;
  double value = 0.0;
  bool mixed = false;              // stands for several that differ: shown as such
  std::string_view infinity_text;  // a word that stands for infinity: "never"; empty: there is no such value
};

// The number that a text means; the word of an endless field is infinity. None: it means none.
std::optional<double> number_typed(std::string_view text, std::string_view infinity_text = {});

// Returns the new value once it is finished by Enter, Tab or a click elsewhere, within the range; Esc takes the typing back.
std::optional<double> typed_row(const TypedField& field, Panels& panels);

}  // namespace hooke
