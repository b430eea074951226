// The values in the descriptions of commands.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/number_text.h"

namespace hooke {

// Three digits, or the whole number from 1000 on: "185 N/m".
inline std::string value_text(double value, std::string_view unit) {
  const std::string number = number_text(value, 3);
  return unit.empty() ? number : number + " " + unit_text(unit);
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
