#include "lab/bounds.h"

#include <charconv>
#include <cmath>

namespace hooke {

std::string shortest(double value) {
  char buffer[32];
  char* const end = buffer + sizeof buffer;
  // 5000000 rather than 5e+06
  const bool is_plain = value == std::trunc(value) && std::abs(value) < 1e15;
  return std::string(buffer,
                     is_plain ? std::to_chars(buffer, end, value, std::chars_format::fixed).ptr : std::to_chars(buffer, end, value).ptr);
}

std::string Bounds::text() const {
  const bool below = std::isfinite(least), above = std::isfinite(most);
  if (!below && !above) return "must be a number";
  if (!below) return "must be at most " + shortest(most);
  if (least_excluded) return "must be more than " + shortest(least) + (above ? " and at most " + shortest(most) : "");
  return above ? "must be from " + shortest(least) + " to " + shortest(most) : "must be at least " + shortest(least);
}

}  // namespace hooke
