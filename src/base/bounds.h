// The values that a quantity may have.
#pragma once

#include <limits>
#include <string>

namespace hooke {

struct Bounds {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_excluded = false;
  bool contains(double value) const { return (min_excluded ? exceeds_min(value) : value >= min) && value <= max; }
  std::string text() const;  // "must be at least 0", for messages

 private:
  // Denormal numbers count as zero: their reciprocal overflows.
  bool exceeds_min(double value) const { return value > min && !(min == 0.0 && value < std::numeric_limits<double>::min()); }
};

inline constexpr Bounds any_number{};
inline constexpr Bounds not_negative{.min = 0.0};
inline constexpr Bounds positive{.min = 0.0, .min_excluded = true};

// The fewest digits that read back as the same number; whole numbers without an exponent, as far as they are exact.
std::string format_exact(double value);

}  // namespace hooke
