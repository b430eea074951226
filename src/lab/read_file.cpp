#include "lab/read_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "lab/file_limits.h"
#include "lab/printable.h"
#include "sim/errors.h"

namespace hooke {
namespace {

struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) close(number);
  }
};

std::string_view kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "a device";
  return "no regular file";
}

[[noreturn]] void refuse_size(const std::string& name, std::uint64_t bytes) {
  throw Refused(name + ": size: " + std::to_string(bytes) + " bytes: must be at most " + std::to_string(most_file_bytes) + " (256 MiB)");
}

}  // namespace

std::string read_file(const std::filesystem::path& file) {
  const std::string name = printable(file.native());
  const auto fail = [&](const char* what) { throw FileError(name + ": " + what + ": " + std::strerror(errno)); };

  // without O_NONBLOCK, opening a pipe would wait for somebody to write
  const Descriptor descriptor{open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)};
  if (descriptor.number < 0) fail("cannot be opened");
  struct stat status;
  if (fstat(descriptor.number, &status) != 0) fail("cannot be read");
  if (!S_ISREG(status.st_mode)) throw Refused(name + ": file: " + std::string(kind_of(status.st_mode)) + ": must be a regular file");
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > most_file_bytes) refuse_size(name, size);

  // files under /proc say 0 bytes, and a file may grow meanwhile: the end is where read() says it is
  std::string bytes(size + 1, '\0');
  std::size_t count = 0;
  for (;;) {
    const ssize_t read_now = read(descriptor.number, bytes.data() + count, bytes.size() - count);
    if (read_now < 0 && errno == EINTR) continue;
    if (read_now < 0) fail("cannot be read");
    if (read_now == 0) break;
    count += static_cast<std::size_t>(read_now);
    if (count > most_file_bytes) refuse_size(name, count);
    if (count == bytes.size()) bytes.resize(bytes.size() + (std::size_t{1} << 16));
  }
  bytes.resize(count);
  return bytes;
}

}  // namespace hooke
