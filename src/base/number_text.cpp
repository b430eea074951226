#include "base/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "base/formatted.h"

namespace hooke {
namespace {

// "⁻12" as superscripts.
std::string superscript(int exponent) {
  constexpr std::array<const char*, 10> digits{"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                               "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text = exponent < 0 ? "\u207b" : "";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[static_cast<std::size_t>(c - '0')];
  return text;
}

std::string as_power(double value, int digits) {
  const std::string all = formatted("%.*e", digits - 1, value);
  const std::size_t e = all.find('e');
  std::string mantissa = all.substr(0, e);
  if (mantissa.find('.') != mantissa.npos) {
    mantissa.erase(mantissa.find_last_not_of('0') + 1);
    if (mantissa.back() == '.') mantissa.pop_back();
  }
  return mantissa + "\u00d710" + superscript(std::atoi(all.c_str() + e + 1));
}

constexpr std::string_view units_with_prefixes[] = {"J", "W", "N", "m", "s", "N/m", "m/s"};

// Empty where there is none. No kiloseconds.
std::string_view prefix_of(int exponent, std::string_view unit) {
  constexpr std::array<std::string_view, 9> prefixes{"f", "p", "n", "\u03bc", "m", "", "k", "M", "G"};
  const int index = exponent / 3 + 5;
  if (std::ranges::find(units_with_prefixes, unit) == std::end(units_with_prefixes)) return {};
  if (index < 0 || index >= static_cast<int>(prefixes.size()) || (unit == "s" && exponent > 0)) return {};
  return prefixes[static_cast<std::size_t>(index)];
}

// Of ten, a multiple of 3; 0 for sizes that need none.
int exponent_of(double size) {
  constexpr double min = 0.01, max = 1e4;
  if (!std::isfinite(size) || size == 0.0 || (size >= min && size < max)) return 0;
  return 3 * static_cast<int>(std::floor(std::log10(size) / 3.0 + 1e-12));
}

}  // namespace

std::string number_text(double value, int digits) {
  constexpr double min = 1e-4, max = 1e7;
  const double size = std::abs(value);
  if (!std::isfinite(value) || size == 0.0) return formatted("%g", size == 0.0 ? 0.0 : value);
  if (size < min || size >= max) return as_power(value, digits);
  std::string text = size >= std::pow(10.0, digits) - 0.5 ? formatted("%.0f", value) : formatted("%.*g", digits, value);
  const std::size_t first = value < 0.0 ? 1 : 0, last = std::min(text.find('.'), text.size());
  for (std::size_t end = last; last > first + 4 && end > first + 3; end -= 3) text.insert(end - 3, ",");
  return text;
}

std::string unit_text(std::string_view unit) {
  std::string text(unit);
  if (const auto at = text.find("^2"); at != text.npos) text.replace(at, 2, "\u00b2");
  if (const auto at = text.find("^3"); at != text.npos) text.replace(at, 2, "\u00b3");
  return text;
}

UnitScale unit_scale(double size, std::string_view unit) {
  const int exponent = exponent_of(std::abs(size));
  if (exponent == 0) return {1.0, unit_text(unit)};
  const double factor = std::pow(10.0, exponent);
  if (const std::string_view prefix = prefix_of(exponent, unit); !prefix.empty()) return {factor, std::string(prefix).append(unit)};
  const std::string power = "10" + superscript(exponent);
  return {factor, unit.empty() || unit == "1" ? power : power + " " + unit_text(unit)};
}

std::string quantity_text(double value, std::string_view unit, int digits) {
  if (unit.empty() || unit == "1") return number_text(value, digits);
  const int exponent = exponent_of(std::abs(value));
  const std::string_view prefix = exponent == 0 ? std::string_view() : prefix_of(exponent, unit);
  const double shown = prefix.empty() ? value : value / std::pow(10.0, exponent);
  return number_text(shown, digits) + " " + std::string(prefix) + unit_text(unit);
}

}  // namespace hooke
