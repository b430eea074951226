// The values in the descriptions of commands.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hooke {

// Three digits, or the whole number from 1000 to a million: "185 N/m".
inline std::string value_text(double value, std::string_view unit) {
  const bool is_long = std::abs(value) >= 1000.0 && std::abs(value) < 1e6;
  char text[48];
  const auto format = is_long ? std::chars_format::fixed : std::chars_format::general;
  const std::string number(text, std::to_chars(text, text + sizeof text, value, format, is_long ? 0 : 3).ptr);
  return unit.empty() ? number : number + " " + std::string(unit);
}

// " to 185 N/m", or " to 90 ... 185 N/m" for several values.
template <class Id>
std::string new_values_text(const std::vector<std::pair<Id, double>>& values, std::string_view unit) {
  if (values.empty()) return "";
  const auto by_value = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto [min, max] = std::minmax_element(values.begin(), values.end(), by_value);
  if (std::isinf(max->second)) return "";
  const std::string min_text = value_text(min->second, ""), max_text = value_text(max->second, "");
  return " to " + (min_text == max_text ? "" : min_text + " ... ") + value_text(max->second, unit);
}

}  // namespace hooke
