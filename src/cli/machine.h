// What measured figures were measured on.
#pragma once

#include <string>

namespace hooke {

// The processor, by its own name.
std::string machine();

}  // namespace hooke
