#include "batch/shard.h"

#include <charconv>

#include "base/option_error.h"
#include "base/printable.h"

namespace hooke {

Shard parse_shard(const std::string& text) {
  constexpr std::size_t max_shards = 1'000'000;
  const char *const begin = text.data(), *const end = begin + text.size();
  Shard shard{.number = 0, .count = 0};
  const auto [slash, number_error] = std::from_chars(begin, end, shard.number);
  const bool has_slash = number_error == std::errc() && slash != end && *slash == '/';
  const auto [last, count_error] = has_slash ? std::from_chars(slash + 1, end, shard.count) : std::from_chars_result{begin, std::errc()};
  const bool is_valid = has_slash && count_error == std::errc() && last == end && shard.number >= 1 && shard.number <= shard.count &&
                        shard.count <= max_shards;
  if (!is_valid) throw OptionError("shard", printable(text, 80), "must be I/N with I from 1 to N, and N at most 1000000");
  return shard;
}

}  // namespace hooke
