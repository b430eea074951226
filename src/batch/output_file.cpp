#include "batch/output_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <utility>

#include "base/errors.h"
#include "base/printable.h"

namespace hooke {
namespace {

// Devices and pipes, which cannot be replaced.
bool is_stream(const std::string& name) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(name, ignored);
  return std::filesystem::is_character_file(status) || std::filesystem::is_fifo(status);
}

[[noreturn]] void fail(const std::string& name, int reason) { throw FileError(name + ": cannot be written: " + std::strerror(reason)); }

}  // namespace

OutputFile::OutputFile(const std::string& name) : display_name_(name == "-" ? "stdout" : printable(name)) {
  if (name == "-") {
    stream_ = stdout;
  } else if (is_stream(name)) {
    stream_ = std::fopen(name.c_str(), "we");
    if (stream_ == nullptr) fail(display_name_, errno);
  } else {
    regular_.emplace(name);
  }
}

OutputFile::~OutputFile() {
  if (stream_ != nullptr && stream_ != stdout) std::fclose(stream_);
}

void OutputFile::write(std::string_view text) {
  if (regular_) return regular_->write(text);
  if (std::fwrite(text.data(), 1, text.size(), stream_) != text.size()) fail(display_name_, errno);
}

void OutputFile::close() {
  if (regular_) return regular_->commit();
  std::FILE* stream = std::exchange(stream_, nullptr);
  if (stream == stdout) return flush_stdout();
  if (std::fclose(stream) != 0) fail(display_name_, errno);
}

void flush_stdout() {
  errno = 0;
  std::cout.flush();
  const bool is_flushed = std::fflush(stdout) == 0;
  // an earlier write may have failed; its reason is then no longer known
  if (!is_flushed || std::ferror(stdout) != 0 || !std::cout) fail("stdout", errno != 0 ? errno : EIO);
}

}  // namespace hooke
