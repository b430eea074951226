// A bar on stderr for work that takes long: on a terminal only.
#pragma once

#include <chrono>

namespace hooke {

class Progress {
 public:
  // Of work in `total` parts. Nothing is shown when not `wanted` or stderr is no terminal.
  Progress(long total, bool wanted);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(long done);

 private:
  using Clock = std::chrono::steady_clock;
  long total_;
  bool shown_ = false, wanted_;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace hooke
