// Values of parameters as text, on the command line and in tables.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scene/parameters.h"

namespace hooke {

// A number in the range of the parameter, whole if it must be; the id of a choice; on or off. None for anything else.
std::optional<double> parse_value(const Parameter& parameter, std::string_view text);

// What a value must be, for messages: "must be on or off", "must be at least 1 and at most 1000 [1/s]".
std::string limit_text(const Parameter& parameter);
// Why parse_value does not accept a text: the same, and that it is not a number.
std::string why_refused(const Parameter& parameter, std::string_view text);

// Reads back as the same value.
std::string value_text(const Parameter& parameter, double value);

}  // namespace hooke
