// A listed force with some of its numbers set.
#pragma once

#include <initializer_list>
#include <string_view>
#include <utility>

#include "sim/forces/force_terms.h"

namespace hooke {

// The other numbers have their defaults.
inline Force force_with(std::string_view id, std::initializer_list<std::pair<std::string_view, double>> values) {
  const ForceTerm& term = *find_force_term(id);
  Force force{.term = &term, .values = default_values(term)};
  for (const auto& [name, value] : values)
    for (std::size_t i = 0; i < term.numbers.size(); ++i)
      if (term.numbers[i].name == name) force.values[i] = value;
  return force;
}

}  // namespace hooke
