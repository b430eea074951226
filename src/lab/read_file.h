// Bytes of a file that somebody gave us.
#pragma once

#include <filesystem>
#include <string>

namespace hooke {

// All of a regular file of at most most_file_bytes. Throws Refused for anything else (a folder, a pipe, a device, a
// larger file), without reading it, and FileError when the system will not open or read it.
std::string read_file(const std::filesystem::path& file);

}  // namespace hooke
