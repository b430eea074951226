#include "base/bounds.h"

#include <charconv>
#include <cmath>

namespace hooke {

std::string format_exact(double value) {
  char buffer[32];
  char* const end = buffer + sizeof buffer;
  // 5000000 rather than 5e+06
  const bool is_plain = value == std::trunc(value) && std::abs(value) < 1e15;
  return std::string(buffer,
                     is_plain ? std::to_chars(buffer, end, value, std::chars_format::fixed).ptr : std::to_chars(buffer, end, value).ptr);
}

std::string Bounds::text() const {
  const bool below = std::isfinite(min), above = std::isfinite(max);
  if (!below && !above) return "must be a number";
  if (!below) return "must be at most " + format_exact(max);
  if (min_excluded) return "must be more than " + format_exact(min) + (above ? " and at most " + format_exact(max) : "");
  return above ? "must be from " + format_exact(min) + " to " + format_exact(max) : "must be at least " + format_exact(min);
}

}  // namespace hooke
