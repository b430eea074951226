#include "ui/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace hooke {
namespace {

constexpr std::string_view unknown = "\ufffd";

}  // namespace

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

RareCharacters::RareCharacters(std::string& text) : text_(text), before_(text) {
  for (std::size_t at = 0; at < text.size(); ++at)
    if ((text[at] & 0xf8) == 0xf0) text.replace(at, 4, unknown);
}

RareCharacters::~RareCharacters() {
  for (std::size_t at = text_.find(unknown), from = 0; at != text_.npos; at = text_.find(unknown, at + 4), from += 4) {
    while (from < before_.size() && (before_[from] & 0xf8) != 0xf0) ++from;
    if (from >= before_.size()) break;
    text_.replace(at, unknown.size(), before_, from, 4);
  }
}

std::string milliseconds_text(double ms) {
  constexpr double smallest = 1e-3;
  return number_text(smallest * std::round(ms / smallest), 2) + " ms";
}

std::string count(long n, std::string_view noun) {
  return number_text(static_cast<double>(n)) + " " + std::string(noun) + (n == 1 ? "" : "s");
}

}  // namespace hooke
