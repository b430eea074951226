// Numbers that a quantity may be.
#pragma once

#include <limits>
#include <string>

namespace hooke {

struct Bounds {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool least_excluded = false;
  bool hold(double value) const { return (least_excluded ? exceeds_least(value) : value >= least) && value <= most; }
  std::string text() const;  // "must be at least 0"

 private:
  // Denormal numbers count as zero: one over them is no number.
  bool exceeds_least(double value) const { return value > least && !(least == 0.0 && value < std::numeric_limits<double>::min()); }
};

inline constexpr Bounds any_number{};
inline constexpr Bounds not_negative{.least = 0.0};
inline constexpr Bounds positive{.least = 0.0, .least_excluded = true};

// The fewest digits that read back as the same number; whole numbers without an exponent, as far as they are exact.
std::string shortest(double value);

}  // namespace hooke
