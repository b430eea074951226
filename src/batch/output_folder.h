// The folder that a command writes its results to.
#pragma once

#include <filesystem>

namespace hooke {

// Creates it with its parents if it does not exist, also where a symbolic link leads to it. Throws FileError.
void make_folder(const std::filesystem::path& folder);

}  // namespace hooke
