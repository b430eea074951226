// Text formats of old: one statement a line, words between blanks.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hooke {

// The lines of a text in turn, whatever ends them ("\n", "\r\n" or "\r").
class TextLines {
 public:
  // The text must outlive this.
  explicit TextLines(std::string_view text) : rest_(text) {}

  // The next line without its end; false when there is none.
  bool next(std::string_view& line);

  // Of the line last given, from 1.
  int number() const { return number_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

// Takes the next word off the front of `line`; empty when only blanks and tabs are left.
std::string_view next_token(std::string_view& line);

// A decimal number of the size of a double ("1", "+.5", "-3e-7"); none for anything else, "nan", "inf" and "1e400" included.
std::optional<double> parse_number(std::string_view word);

// A whole number that an int holds; none for anything else.
std::optional<int> parse_integer(std::string_view word);

// A number in six digits, for messages.
std::string format_rounded(double value);

// "1 mass", "2 masses".
std::string pluralize(std::size_t count, const std::string& singular, const std::string& plural);

// "FILE: line 12" to begin a message with.
std::string line_location(const std::string& file, int line);

}  // namespace hooke
