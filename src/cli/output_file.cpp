#include "cli/output_file.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include "base/errors.h"
#include "base/printable.h"

namespace hooke {

OutputFile::OutputFile(const std::string& name)
    : display_name_(name == "-" ? "stdout" : printable(name)), file_(name == "-" ? stdout : std::fopen(name.c_str(), "we")) {
  if (file_ == nullptr) throw FileError(display_name_ + ": cannot be written: " + std::strerror(errno));
}

OutputFile::~OutputFile() {
  if (file_ != nullptr && file_ != stdout) std::fclose(file_);
}

void OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size())
    throw FileError(display_name_ + ": cannot be written: " + std::strerror(errno));
}

void OutputFile::close() {
  std::FILE* file = std::exchange(file_, nullptr);
  const bool arrived = file == stdout ? std::fflush(file) == 0 : std::fclose(file) == 0;
  if (!arrived) throw FileError(display_name_ + ": cannot be written: " + std::strerror(errno));
}

}  // namespace hooke
