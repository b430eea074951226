#include "lab/bounds.h"

#include <charconv>
#include <cmath>

namespace hooke {

std::string shortest(double value) {
  char buffer[32];
  return std::string(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

std::string Bounds::text() const {
  const bool below = std::isfinite(least), above = std::isfinite(most);
  if (!below && !above) return "must be a number";
  if (!below) return "must be at most " + shortest(most);
  if (least_excluded) return "must be more than " + shortest(least) + (above ? " and at most " + shortest(most) : "");
  return above ? "must be from " + shortest(least) + " to " + shortest(most) : "must be at least " + shortest(least);
}

}  // namespace hooke
