// Whether the file of the document is still what was read or written last.
#pragma once

#include <cstdint>
#include <filesystem>

namespace hooke {

class FileWatch {
 public:
  enum class Change { None, Gone, Other };

  // From now on this file as it is now; an empty path: none.
  void take(const std::filesystem::path& file);
  Change check() const;

 private:
  struct FileStamp {
    bool exists = false;
    std::uint64_t device = 0, number = 0, size = 0;
    std::int64_t seconds = 0, nanoseconds = 0;  // of its last change
    bool operator==(const FileStamp&) const = default;
  };
  static FileStamp stamp_of(const std::filesystem::path& file);

  std::filesystem::path file_;
  FileStamp stamp_;
};

}  // namespace hooke
