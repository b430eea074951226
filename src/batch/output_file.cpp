#include "batch/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
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

OutputFile::OutputFile(const std::string& name, Writing writing) : display_name_(name == "-" ? "stdout" : printable(name)) {
  if (name == "-") {
    stream_ = stdout;
  } else if (is_stream(name)) {
    stream_ = std::fopen(name.c_str(), "we");
    if (stream_ == nullptr) fail(display_name_, errno);
  } else {
    regular_.emplace(name, writing);
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

void require_separate_files(const std::string& input, std::initializer_list<NamedOutput> outputs) {
  namespace fs = std::filesystem;
  const auto is_same = [](const std::string& a, const std::string& b) {
    std::error_code error;
    if (a == "-" || b == "-") return a == b;
    if (is_stream(a) || is_stream(b)) return false;
    if (fs::equivalent(a, b, error) && !error) return true;
    return fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error) && !error;
  };
  for (const NamedOutput* output = outputs.begin(); output != outputs.end(); ++output) {
    if (!output->file) continue;
    const std::string name = std::string(output->option) + " " + printable(*output->file, 80);
    // the name of a shipped scene is no file
    if (std::error_code error; *output->file != "-" && fs::exists(input, error) && is_same(*output->file, input))
      throw UsageError(name + ": would replace the scene");
    for (const NamedOutput* earlier = outputs.begin(); earlier != output; ++earlier)
      if (earlier->file && is_same(*earlier->file, *output->file))
        throw UsageError(name + ": is the file of " + std::string(earlier->option) + " too");
  }
}

void flush_stdout() {
  errno = 0;
  std::cout.flush();
  const bool is_flushed = std::fflush(stdout) == 0;
  if (is_flushed && std::ferror(stdout) == 0 && std::cout) return;
  // an earlier write failed, and its reason is no longer known: another write fails for the same one
  if (errno == 0 && ::write(STDOUT_FILENO, "\n", 1) == 1) errno = EIO;
  fail("stdout", errno);
}

void make_folder(const std::filesystem::path& folder) {
  const auto check = [&](const std::error_code& failure) {
    if (failure) throw FileError(printable(folder.native()) + ": cannot be created: " + failure.message());
  };
  if (folder.empty()) check(std::make_error_code(std::errc::no_such_file_or_directory));
  std::filesystem::path part;
  // each part may be a link to a folder that does not exist yet
  for (const std::filesystem::path& name : folder) {
    part /= name;
    std::error_code missing, failure;
    if (std::filesystem::is_directory(part, missing)) continue;
    const std::filesystem::path target = follow_links(part, failure);
    if (!failure) std::filesystem::create_directories(target, failure);
    check(failure);
  }
}

}  // namespace hooke
