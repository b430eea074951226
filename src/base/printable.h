// Text of unknown origin, made fit for a line on a terminal or a label.
#pragma once

#include <string>
#include <string_view>

namespace hooke {

// Control characters as "\n", "\t" or "\u001b", bytes that are no UTF-8 as "\xff"; everything else as it is.
std::string printable(std::string_view text);

// The same, cut to about `most` bytes, with "..." where it was cut.
std::string printable(std::string_view text, std::size_t max);

// RFC 3629: no overlong forms, no surrogates, nothing past U+10FFFF.
bool is_utf8(std::string_view text);

}  // namespace hooke
