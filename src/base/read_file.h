// Bytes of a file that somebody gave us.
#pragma once

#include <filesystem>
#include <string>

namespace hooke {

// All of a regular file of at most max_file_bytes. Throws InputError for anything else (a folder, a pipe, a device, a
// larger file), without reading it, and FileError when the system will not open or read it.
std::string read_file(const std::filesystem::path& file);

// The same of a file that lies in `folder` or below it, whatever `way` says and whatever links stand on it: a way that is
// absolute, goes up or passes a link is refused. `name` stands for it in messages.
std::string read_file_within(const std::filesystem::path& folder, const std::filesystem::path& path, const std::string& name);

}  // namespace hooke
