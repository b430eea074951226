// Makes untrusted text safe for one line of a terminal or a label.
#pragma once

#include <string>
#include <string_view>

namespace hooke {

// Control characters as "\n", "\t" or "\u001b", bytes that are not valid UTF-8 as "\xff"; everything else unchanged.
std::string printable(std::string_view text);

// The same, truncated to about `max` bytes with "...".
std::string printable(std::string_view text, std::size_t max);

// A message that quotes something long, and ends with a reason: the first and the last half of `max` bytes, with "..." between.
inline constexpr std::size_t max_message_bytes = 2000;
std::string without_middle(std::string_view text, std::size_t max = max_message_bytes);

// RFC 3629: no overlong forms, no surrogates, nothing past U+10FFFF.
bool is_utf8(std::string_view text);

}  // namespace hooke
