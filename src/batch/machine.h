// The machine and the time of a measurement.
#pragma once

#include <string>

namespace hooke {

// The name of the processor.
std::string machine();

// The current time in UTC, in a strftime format.
std::string time_text(const char* format);

}  // namespace hooke
