// A field of a CSV file.
#pragma once

#include <string>
#include <string_view>

namespace hooke {

// In quotes if it contains a comma, a quote or a line break (RFC 4180).
inline std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace hooke
