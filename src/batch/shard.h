// Work divided among processes: part 2 of 8 is the second of eight parts.
#pragma once

#include <cstddef>
#include <string>

namespace hooke {

struct Shard {
  std::size_t number = 1, count = 1;  // number from 1 to count
  // Every count-th item, so that each part gets long and short ones.
  bool has(std::size_t item) const { return item % count == number - 1; }
  // The number of items of this part.
  std::size_t count_of(std::size_t items) const { return items / count + (items % count >= number ? 1 : 0); }
};

// "2/8". Throws UsageError.
Shard parse_shard(const std::string& text);

}  // namespace hooke
