// Files that are written completely or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>

namespace hooke {

// One of many files that can be produced again, such as the pictures of a run: it is replaced at once like the others, but an fsync of
// each would take as long as drawing it, and a search for temporary files of killed writers would take longer with every file.
enum class Writing { Durable, OneOfMany };

// A file that grows as a temporary file in the same folder and takes its place on `commit`: fsync, rename, fsync of the folder. At
// every moment there is the old file or the new one. An existing file keeps its permissions; a symbolic link stays, and the file it
// leads to is replaced, or created if the link dangles. Everything throws FileError; the old file is then unchanged, unless only the folder
// could not be flushed. Temporary files of writers that were killed are removed.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& file, Writing writing = Writing::Durable);
  ~AtomicFile();  // without `commit`: removes the temporary file
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  // Replaces bytes written before, from `offset` on.
  void overwrite(std::size_t offset, std::string_view bytes);
  void commit();

 private:
  struct Destination;
  void flush();
  std::unique_ptr<Destination> destination_;
};

// The path that the symbolic links at the end of `path` lead to, whether or not anything exists there. Circular links are an error.
std::filesystem::path follow_links(const std::filesystem::path& path, std::error_code& error);

// Replaces the content of `file` by `bytes`, as an AtomicFile.
void write_atomically(const std::filesystem::path& file, std::string_view bytes);

}  // namespace hooke
