// Formatting of numbers and counts for the panels.
#pragma once

#include <string>
#include <string_view>

namespace hooke {

// Four significant digits: "1000", "0.1667", "2.5e+04".
std::string number(double value);
// "3 points", "1 point"
std::string count(long n, std::string_view noun);

}  // namespace hooke
