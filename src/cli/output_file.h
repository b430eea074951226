// Where results go: a file, or stdout.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace hooke {

class OutputFile {
 public:
  // "-" is stdout. Throws FileError, as all of them do.
  explicit OutputFile(const std::string& name);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  // Makes sure that all of it arrived; to be called when everything is written.
  void close();

 private:
  std::string display_name_;
  std::FILE* file_;
};

}  // namespace hooke
