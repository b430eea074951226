// What measured figures were measured on, and when.
#pragma once

#include <string>

namespace hooke {

// The processor, by its own name.
std::string machine();

// The time now at Greenwich, in the format of strftime.
std::string time_text(const char* format);

}  // namespace hooke
