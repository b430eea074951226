#include "ui/text.h"

#include <cstdio>

namespace hooke {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string count(long many, std::string_view noun) { return std::to_string(many) + " " + std::string(noun) + (many == 1 ? "" : "s"); }

}  // namespace hooke
