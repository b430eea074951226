// A temporary folder for a test, removed when the test ends.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace hooke {

struct ScratchFolder {
  std::filesystem::path folder;

  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "hooke-test-XXXXXX").string();
    folder = mkdtemp(name.data());
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
};

}  // namespace hooke
