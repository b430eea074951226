// Files that are written whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace hooke {

// Puts `bytes` where `file` is: a temporary file in the same folder, fsync, rename, fsync of the folder, so that at every
// moment there is the old file or the new one. An old file's permissions stay; a symbolic link stays, and the file it
// leads to is replaced. Throws FileError; the old file is then as it was, unless only the folder could not be flushed.
// Temporary files left by writers that were killed are removed.
void write_atomically(const std::filesystem::path& file, std::string_view bytes);

}  // namespace hooke
