// Line-based text formats: one statement per line, words separated by blanks.
#pragma once

#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hooke {

// The lines of a text, terminated by any of ("\n", "\r\n" or "\r").
class TextLines {
 public:
  // The text must outlive this object.
  explicit TextLines(std::string_view text) : rest_(text) {}

  // The next line without its terminator; false at the end.
  bool next(std::string_view& line);

  // Of the last line returned, from 1.
  int number() const { return number_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

// Removes the next word from the front of `line`; empty if only blanks and tabs are left.
std::string_view next_token(std::string_view& line);

// The parts of a text between separators: at least one, which may be empty.
std::vector<std::string_view> split(std::string_view text, char separator);

// A decimal number within the range of a double ("1", "+.5", "-3e-7"); none for anything else, including "nan", "inf" and "1e400".
std::optional<double> parse_number(std::string_view word);

// An integer within the range of int; none for anything else.
std::optional<int> parse_integer(std::string_view word);

// A number with six digits, for messages.
std::string format_rounded(double value);

// "1 mass", "2 masses".
std::string pluralize(std::size_t count, const std::string& singular, const std::string& plural);

// The items, or what `of` makes of each, with ", " between, and before the last one `last`: "cloth, rope or flag".
template <class Items, class Of = std::identity>
std::string joined(const Items& items, const Of& of = {}, std::string_view last = ", ") {
  std::string text;
  for (std::size_t i = 0; i < std::size(items); ++i)
    text.append(i == 0 ? "" : i + 1 < std::size(items) ? ", " : last).append(std::invoke(of, items[i]));
  return text;
}

// "FILE: line 12", the start of a message.
std::string line_location(const std::string& file, int line);

}  // namespace hooke
