#include "app/document/file_watch.h"

#include <sys/stat.h>

namespace hooke {

void FileWatch::take(const std::filesystem::path& file) {
  file_ = file;
  stamp_ = stamp_of(file);
}

FileWatch::Change FileWatch::check() const {
  if (file_.empty() || !stamp_.exists) return Change::None;
  const FileStamp now = stamp_of(file_);
  if (!now.exists) return Change::Deleted;
  return now == stamp_ ? Change::None : Change::Modified;
}

std::optional<FileWatch::Change> FileWatch::check_at(double now) {
  constexpr double period = 1.0;  // [s]
  if (now < checked_at_ + period) return std::nullopt;
  checked_at_ = now;
  return check();
}

FileWatch::FileStamp FileWatch::stamp_of(const std::filesystem::path& file) {
  struct stat status;
  if (file.empty() || ::stat(file.c_str(), &status) != 0) return {};
  return {true, status.st_dev, status.st_ino, static_cast<std::uint64_t>(status.st_size), status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

}  // namespace hooke
