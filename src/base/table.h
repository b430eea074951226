// A table whose rows are constants in files of their own. It holds references, so that a row found in the table is the constant
// itself and rows can be compared by address.
#pragma once

#include <ranges>
#include <span>

namespace hooke {

struct Dereference {
  template <class Row>
  const Row& operator()(const Row* row) const {
    return *row;
  }
};

// Read as a list: `for (const Row& row : table)`, `table[i]`, `table.size()`.
template <class Row>
using Table = std::ranges::transform_view<std::span<const Row* const>, Dereference>;

}  // namespace hooke
