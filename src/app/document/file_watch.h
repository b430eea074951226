// Detects changes of the file of the document by other programs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace hooke {

class FileWatch {
 public:
  enum class Change { None, Deleted, Modified };

  // Watches this file from its current state on; no file if the path is empty.
  void take(const std::filesystem::path& file);
  Change check() const;
  // Once per frame, at `now` [s]: checks once in a while.
  std::optional<Change> check_at(double now);

 private:
  struct FileStamp {
    bool exists = false;
    std::uint64_t device = 0, number = 0, size = 0;
    std::int64_t seconds = 0, nanoseconds = 0;  // of the last modification
    bool operator==(const FileStamp&) const = default;
  };
  static FileStamp stamp_of(const std::filesystem::path& file);

  std::filesystem::path file_;
  FileStamp stamp_;
  double checked_at_ = 0.0;  // [s]
};

}  // namespace hooke
