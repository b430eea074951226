#include "base/atomic_write.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

#include "base/errors.h"
#include "base/formatted.h"
#include "base/printable.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

// Names of temporary files: ".hooke-" and 16 digits. Their length does not depend on the name of the target.
constexpr std::string_view prefix = ".hooke-";
constexpr std::size_t digits = 16;

bool is_temporary(const std::string& name) {
  return name.size() == prefix.size() + digits && name.starts_with(prefix) &&
         name.find_first_not_of("0123456789abcdef", prefix.size()) == std::string::npos;
}

std::string new_temporary_name() {
  std::uint64_t number = 0;
  if (getrandom(&number, sizeof number, 0) != sizeof number) number = static_cast<std::uint64_t>(getpid());
  return std::string(prefix) + formatted("%016llx", static_cast<unsigned long long>(number));
}

struct Descriptor {
  int number;
  explicit Descriptor(int opened) : number(opened) {}
  ~Descriptor() {
    if (number >= 0) close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
};

// A temporary file in a folder, removed unless it was renamed. It is locked as long as the object lives.
class Temporary {
 public:
  explicit Temporary(int folder) : folder_(folder) {
    // until it is locked, another writer may remove it as stale: then try again
    struct stat status;
    do {
      if (number_ >= 0) close(number_);
      name_ = new_temporary_name();
      number_ = openat(folder_, name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
      if (number_ < 0) return;
    } while (flock(number_, LOCK_EX) == 0 && fstat(number_, &status) == 0 && status.st_nlink == 0);
  }
  ~Temporary() {
    if (number_ < 0) return;
    if (!renamed_) unlinkat(folder_, name_.c_str(), 0);
    close(number_);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  int number() const { return number_; }
  bool rename_to(const std::string& name) {
    renamed_ = renameat(folder_, name_.c_str(), folder_, name.c_str()) == 0;
    return renamed_;
  }

 private:
  int folder_;
  std::string name_;
  int number_ = -1;
  bool renamed_ = false;
};

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

// Removes the temporary files of killed writers: those that no process has locked.
void remove_stale_files(const fs::path& folder, int folder_number) {
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end; entry.increment(ignored)) {
    const std::string name = entry->path().filename();
    if (!is_temporary(name)) continue;
    const Descriptor stale(openat(folder_number, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat status;
    if (stale.number >= 0 && fstat(stale.number, &status) == 0 && S_ISREG(status.st_mode) && flock(stale.number, LOCK_EX | LOCK_NB) == 0)
      unlinkat(folder_number, name.c_str(), 0);
  }
}

fs::path target_of(const fs::path& file, const std::string& printable_name) {
  std::error_code error;
  fs::path target = follow_links(file, error);
  if (error) throw FileError(printable_name + ": cannot be written: " + error.message());
  return target;
}

// Bytes that are collected before they are written.
constexpr std::size_t buffer_size = 1 << 16;

}  // namespace

struct AtomicFile::Destination {
  Destination(const fs::path& file, Writing kind);
  [[noreturn]] void fail(const char* what, int reason) const {
    throw FileError(printable_name + ": " + what + ": " + std::strerror(reason));
  }

  Writing writing;
  std::string printable_name;
  fs::path target, folder_path;
  Descriptor folder;
  std::string name;
  std::optional<Temporary> temporary;
  std::string buffer;
};

AtomicFile::Destination::Destination(const fs::path& file, Writing kind)
    : writing(kind),
      printable_name(printable(file.native())),
      target(target_of(file, printable_name)),
      folder_path(target.has_parent_path() ? target.parent_path() : fs::path(".")),
      folder(open(folder_path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)),
      name(target.filename()) {
  const int reason = errno;
  if (target != file) printable_name += " (a link to " + printable(target.native()) + ")";
  if (folder.number < 0) fail("cannot be written", reason);
  if (name.empty() || name == "." || name == "..") throw FileError(printable_name + ": not a file name");

  // an existing file keeps its permissions; anything but a regular file is not replaced
  struct stat old;
  const bool exists = fstatat(folder.number, name.c_str(), &old, AT_SYMLINK_NOFOLLOW) == 0;
  if (!exists && errno != ENOENT) fail("cannot be written", errno);
  if (exists && !S_ISREG(old.st_mode)) throw FileError(printable_name + ": cannot be written: not a regular file");
  if (exists && faccessat(folder.number, name.c_str(), W_OK, AT_EACCESS) != 0) fail("cannot be written", errno);

  if (writing == Writing::Durable) remove_stale_files(folder_path, folder.number);
  temporary.emplace(folder.number);
  if (temporary->number() < 0) fail("cannot be written", errno);
  if (exists && fchmod(temporary->number(), old.st_mode & 07777) != 0) fail("cannot set its permissions", errno);
}

AtomicFile::AtomicFile(const fs::path& file, Writing writing) : destination_(std::make_unique<Destination>(file, writing)) {}
AtomicFile::~AtomicFile() = default;

void AtomicFile::write(std::string_view bytes) {
  destination_->buffer += bytes;
  if (destination_->buffer.size() >= buffer_size) flush();
}

void AtomicFile::flush() {
  if (!write_all(destination_->temporary->number(), destination_->buffer)) destination_->fail("cannot be written", errno);
  destination_->buffer.clear();
}

void AtomicFile::overwrite(std::size_t offset, std::string_view bytes) {
  flush();
  const int file = destination_->temporary->number();
  const off_t end = lseek(file, 0, SEEK_CUR);
  if (end < 0 || lseek(file, static_cast<off_t>(offset), SEEK_SET) < 0 || !write_all(file, bytes) || lseek(file, end, SEEK_SET) < 0)
    destination_->fail("cannot be written", errno);
}

void AtomicFile::commit() {
  flush();
  const bool is_durable = destination_->writing == Writing::Durable;
  if (is_durable && fsync(destination_->temporary->number()) != 0) destination_->fail("cannot be written", errno);
  if (!destination_->temporary->rename_to(destination_->name)) destination_->fail("cannot be replaced", errno);

  // some file systems do not support fsync of a folder
  if (is_durable && fsync(destination_->folder.number) != 0 && errno != EINVAL && errno != EROFS)
    destination_->fail("was written, but its folder could not be flushed", errno);
}

fs::path follow_links(const fs::path& path, std::error_code& error) {
  constexpr int max_links = 40;  // the limit of the kernel
  fs::path target = path;
  error.clear();
  std::error_code missing;
  for (int links = 0; fs::is_symlink(fs::symlink_status(target, missing)); ++links) {
    if (links == max_links) error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
    const fs::path next = error ? fs::path() : fs::read_symlink(target, error);
    if (error) return path;
    target = target.parent_path() / next;
  }
  return target;
}

void write_atomically(const fs::path& file, std::string_view bytes) {
  AtomicFile output(file);
  output.write(bytes);
  output.commit();
}

}  // namespace hooke
