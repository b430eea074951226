#include "sim/forces/force_term.h"

#include "sim/forces/rows.h"

namespace hooke {

std::span<const ForceTerm> force_terms() {
  // sticky last: it holds against the sum of all others
  static const std::array rows{wind_force, buoyancy_force, center_force, mass_center_force, wall_force, sticky_force};
  return rows;
}

const ForceTerm* find_force_term(std::string_view id) {
  for (const ForceTerm& row : force_terms())
    if (row.id == id) return &row;
  return nullptr;
}

ForceValues default_values(const ForceTerm& term) {
  ForceValues values{};
  for (std::size_t i = 0; i < term.numbers.size(); ++i) values[i] = term.numbers[i].default_value;
  return values;
}

}  // namespace hooke
