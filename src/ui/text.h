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
// Of the time that something takes [ms]: "57 ms", "0.31 ms".
std::string milliseconds_text(double ms);
// "3 points", "1 point"
std::string count(long n, std::string_view noun);

// Around a text field of ImGui, which knows no characters of four bytes, such as emoji: it has U+FFFD in their place.
class RareCharacters {
 public:
  explicit RareCharacters(std::string& text);
  ~RareCharacters();

 private:
  std::string& text_;
  std::string before_;
};

}  // namespace hooke
