#include "batch/shard.h"

#include "base/option_error.h"
#include "base/printable.h"
#include "base/text_lines.h"

namespace hooke {

Shard parse_shard(const std::string& text) {
  constexpr int max_shards = 1'000'000;
  const std::vector<std::string_view> words = split(text, '/');
  const int number = parse_integer(words[0]).value_or(0), count = parse_integer(words.back()).value_or(0);
  if (words.size() != 2 || number < 1 || number > count || count > max_shards)
    throw OptionError("shard", printable(text, 80), "must be I/N with I from 1 to N, and N at most 1000000");
  return {static_cast<std::size_t>(number), static_cast<std::size_t>(count)};
}

}  // namespace hooke
