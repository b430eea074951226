#include "base/read_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <iterator>
#include <utility>

#include "base/file_limits.h"
#include "base/printable.h"

namespace hooke {
namespace {

struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) close(number);
  }
};

std::string_view file_type_name(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "a device";
  return "not a regular file";
}

[[noreturn]] void refuse_size(const std::string& name, std::uint64_t bytes) {
  throw InputError(name + ": size: " + std::to_string(bytes) + " bytes: must be at most " + std::to_string(max_file_bytes) + " (256 MiB)");
}

[[noreturn]] void fail(const std::string& name, const char* what) {
  const std::string line = name + ": " + what + ": " + std::strerror(errno);
  if (errno == ENOENT) throw MissingFileError(line);
  throw FileError(line);
}

// without O_NONBLOCK, opening a pipe waits for a writer
constexpr int read_flags = O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY;

std::string read_all(const Descriptor& descriptor, const std::string& name) {
  struct stat status;
  if (fstat(descriptor.number, &status) != 0) fail(name, "cannot be read");
  if (!S_ISREG(status.st_mode))
    throw InputError(name + ": file: " + std::string(file_type_name(status.st_mode)) + ": must be a regular file");
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > max_file_bytes) refuse_size(name, size);

  // files under /proc report a size of 0, and a file may grow meanwhile: read() determines the end
  std::string bytes(size + 1, '\0');
  std::size_t count = 0;
  for (;;) {
    const ssize_t bytes_read = read(descriptor.number, bytes.data() + count, bytes.size() - count);
    if (bytes_read < 0 && errno == EINTR) continue;
    if (bytes_read < 0) fail(name, "cannot be read");
    if (bytes_read == 0) break;
    count += static_cast<std::size_t>(bytes_read);
    if (count > max_file_bytes) refuse_size(name, count);
    if (count == bytes.size()) bytes.resize(bytes.size() + (std::size_t{1} << 16));
  }
  bytes.resize(count);
  return bytes;
}

// One gzip file, or several one after the other.
std::string decompressed(const std::string& bytes, const std::string& name) {
  struct Inflater {
    z_stream stream{};
    ~Inflater() { inflateEnd(&stream); }
  } inflater;
  z_stream& stream = inflater.stream;
  constexpr int gzip_only = 16;  // added to the size of the window (zlib.h)
  if (inflateInit2(&stream, MAX_WBITS + gzip_only) != Z_OK) throw FileError(name + ": cannot be decompressed");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string text;
  std::string block(std::size_t{1} << 16, '\0');
  for (;;) {
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    const int result = inflate(&stream, Z_NO_FLUSH);
    text.append(block, 0, block.size() - stream.avail_out);
    if (text.size() > max_file_bytes) refuse_size(name, text.size());
    if (result == Z_STREAM_END) {
      if (stream.avail_in == 0) return text;
      inflateReset(&stream);
    } else if (result != Z_OK) {
      throw InputError(name + ": file: damaged or incomplete gzip");
    }
  }
}

}  // namespace

std::string read_text_file(const std::filesystem::path& file) {
  const std::string name = printable(file.native());
  std::string text = read_file(file);
  if (text.starts_with("\x1f\x8b")) text = decompressed(text, name);
  if (text.starts_with("\xef\xbb\xbf")) return text.substr(3);
  // every second byte of ASCII characters in UTF-16 is 0, and three of four in UTF-32, where the mark has two zeros
  const bool has_mark = text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
  const auto is_zero = [&](std::size_t i) { return i < text.size() && text[i] == '\0'; };
  const bool is_wide = text.size() >= 4 && (is_zero(0) && is_zero(1)) != (is_zero(2) && is_zero(3));
  if (is_wide || has_mark || (text.size() >= 2 && is_zero(0) != is_zero(1)))
    throw InputError(name + ": encoding: " + (is_wide ? "UTF-32" : "UTF-16") + ": must be UTF-8 or ASCII");
  return text;
}

std::string read_file(const std::filesystem::path& file) {
  const std::string name = printable(file.native());
  const Descriptor descriptor{open(file.c_str(), read_flags)};
  if (descriptor.number < 0) fail(name, "cannot be opened");
  return read_all(descriptor, name);
}

// Opens one folder after the other, each relative to the last, so that a link created meanwhile is not followed.
std::string read_file_within(const std::filesystem::path& folder, const std::filesystem::path& path, const std::string& name) {
  const auto refuse = [&] { throw InputError(name + ": must be in the folder of the scene, and not reached through a link"); };
  const std::filesystem::path steps = path.lexically_normal();  // no link is followed, so "a/.." leads nowhere else
  if (steps.empty() || steps.is_absolute()) refuse();
  Descriptor current{open(folder.empty() ? "." : folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)};
  if (current.number < 0) fail(name, "cannot be opened");
  for (auto component = steps.begin(); component != steps.end(); ++component) {
    if (component->empty() || *component == "." || *component == "..") refuse();
    const bool is_last = std::next(component) == steps.end();
    struct stat status;
    if (fstatat(current.number, component->c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(status.st_mode)) refuse();
    Descriptor next{openat(current.number, component->c_str(), O_NOFOLLOW | (is_last ? read_flags : O_PATH | O_DIRECTORY | O_CLOEXEC))};
    if (next.number < 0) fail(name, "cannot be opened");
    std::swap(current.number, next.number);
  }
  return read_all(current, name);
}

}  // namespace hooke
