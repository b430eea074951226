#include "ui/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace hooke {

std::string with_unit(double value, std::string_view unit) { return number_text(value) + (unit.empty() ? "" : " " + unit_text(unit)); }

std::string typed_text(double value) {
  constexpr double min = 1e-12, max = 1e15;
  constexpr int digits = 6;
  const double size = std::abs(value);
  char text[48];
  if (!(size >= min && size < max)) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    return text;
  }
  const int decimals = std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(size))));
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  std::string all(text);
  if (all.find('.') != all.npos) {
    all.erase(all.find_last_not_of('0') + 1);
    if (all.back() == '.') all.pop_back();
  }
  return all;
}

std::string with_rare_characters(std::string typed, std::string_view before) {
  constexpr std::string_view unknown = "\ufffd";
  typed.resize(std::strlen(typed.c_str()));  // it may end in a NUL, where characters became shorter
  for (std::size_t at = typed.find(unknown), from = 0; at != typed.npos; at = typed.find(unknown, at + 4), from += 4) {
    while (from < before.size() && (before[from] & 0xf8) != 0xf0) ++from;
    if (from >= before.size()) break;
    typed.replace(at, unknown.size(), before.substr(from, 4));
  }
  return typed;
}

std::string count(long n, std::string_view noun) { return std::to_string(n) + " " + std::string(noun) + (n == 1 ? "" : "s"); }

}  // namespace hooke
