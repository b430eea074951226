#include "app/file_watch.h"

#include <sys/stat.h>

namespace hooke {

void FileWatch::take(const std::filesystem::path& file) {
  file_ = file;
  mark_ = mark_of(file);
}

FileWatch::Change FileWatch::look() const {
  if (file_.empty() || !mark_.exists) return Change::None;
  const Mark now = mark_of(file_);
  if (!now.exists) return Change::Gone;
  return now == mark_ ? Change::None : Change::Other;
}

FileWatch::Mark FileWatch::mark_of(const std::filesystem::path& file) {
  struct stat status;
  if (file.empty() || ::stat(file.c_str(), &status) != 0) return {};
  return {true, status.st_dev, status.st_ino, static_cast<std::uint64_t>(status.st_size), status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

}  // namespace hooke
