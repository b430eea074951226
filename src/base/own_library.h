// Where the running code is: in a program, or in a shared library such as the Python module.
#pragma once

#include <filesystem>

namespace hooke {

// The file of the shared library that this code is part of; empty: it is part of a program.
std::filesystem::path own_library();

}  // namespace hooke
