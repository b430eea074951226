// The output of a command: a file, stdout or a folder.
#pragma once

#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "base/atomic_write.h"

namespace hooke {

// A regular file is replaced when everything is written (base/atomic_write.h); stdout, devices and pipes are written immediately.
class OutputFile {
 public:
  // "-" is stdout. Throws FileError, as all members do.
  explicit OutputFile(const std::string& name, Writing writing = Writing::Durable);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  // Must be called after the last write: without it a regular file is not replaced.
  void close();

 private:
  std::string display_name_;
  std::optional<AtomicFile> regular_;
  std::FILE* stream_ = nullptr;  // null: the file is a regular one
};

// The file of an option; none: not given.
struct NamedOutput {
  std::string_view option;  // "--json"
  const std::optional<std::string>& file;
};
// Throws UsageError if two outputs are the same file, or one is the input, which it would replace. "-" is stdout.
void require_separate_files(const std::string& input, std::initializer_list<NamedOutput> outputs);

// Flushes stdout. Throws FileError if any output of the program to stdout is lost.
void flush_stdout();

// Creates the folder with its parents if it does not exist, also where a symbolic link leads to it. Throws FileError.
void make_folder(const std::filesystem::path& folder);

}  // namespace hooke
