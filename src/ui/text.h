// Formatting of numbers and counts for the panels.
#pragma once

#include <string>
#include <string_view>

#include "base/number_text.h"

namespace hooke {

// "0.1667 m/s", without a prefix: a value as it is typed.
std::string with_unit(double value, std::string_view unit);
// Six digits that can be typed again: "1500000", "0.000025".
std::string typed_text(double value);
// The typed text with the characters of four bytes, such as emoji, of the text before: a text field of ImGui turns them into U+FFFD.
std::string with_rare_characters(std::string typed, std::string_view before);
// "3 points", "1 point"
std::string count(long n, std::string_view noun);

}  // namespace hooke
