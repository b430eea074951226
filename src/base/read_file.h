// Reads untrusted files.
#pragma once

#include <filesystem>
#include <string>

#include "base/errors.h"

namespace hooke {

// A file that does not exist.
struct MissingFileError : FileError {
  using FileError::FileError;
};

// The content of a regular file of at most max_file_bytes. Throws InputError for anything else (a folder, a pipe, a device, a larger file),
// without reading it, and FileError if the system cannot open or read it, MissingFileError if there is none.
std::string read_file(const std::filesystem::path& file);

// The text of a file, which may be compressed (gzip) and begin with the byte order mark of UTF-8. Throws InputError also for UTF-16 and
// UTF-32, and for compressed text that is damaged or of more than max_file_bytes.
std::string read_text_file(const std::filesystem::path& file);

// The contents of a file in `folder` or its subfolders, with the limits and errors of read_file. Refuses an absolute path, one that leads
// out of the folder, and symbolic links. `name` stands for the file in messages.
std::string read_file_within(const std::filesystem::path& folder, const std::filesystem::path& path, const std::string& name);

}  // namespace hooke
