// Reads a whole file.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace hooke {

// Empty if the file cannot be read.
inline std::string contents(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

}  // namespace hooke
