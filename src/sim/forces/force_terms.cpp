#include "sim/forces/force_terms.h"

#include "sim/forces/terms/rows.h"

namespace hooke {

Table<ForceTerm> force_terms() {
#define ROW(name) &(name),
  static constexpr const ForceTerm* rows[] = {
#include "sim/forces/terms/list.inc"
  };
#undef ROW
  return Table<ForceTerm>(rows);
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
