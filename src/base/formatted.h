// Text by a printf pattern, of any length.
#pragma once

#include <string>

namespace hooke {

std::string formatted(const char* pattern, ...) __attribute__((format(printf, 1, 2)));
void append_formatted(std::string& text, const char* pattern, ...) __attribute__((format(printf, 2, 3)));

}  // namespace hooke
