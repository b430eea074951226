// A program that runs beside this one, in a process group of its own, and whose output is read line by line.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hooke {

class ChildProcess {
 public:
  // Starts the program, found by PATH, with `folder` as working directory and its stdout and stderr in one stream. No shell is involved.
  // Throws FileError if it cannot be started.
  ChildProcess(const std::vector<std::string>& words, const std::filesystem::path& folder);
  ~ChildProcess();  // ends it with all processes that it started
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Passes each line of output to `line` until the program has closed its output or `should_continue`, called several times a second,
  // returns false: the program then gets a request to end. Returns its exit code, 128 + N if signal N ended it.
  int wait(const std::function<void(const std::string&)>& line, const std::function<bool()>& should_continue);

 private:
  void end();
  pid_t id_ = 0;
  int output_ = -1;
  bool has_ended_ = false;
  int status_ = 0;
};

}  // namespace hooke
