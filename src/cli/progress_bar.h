// A bar on stderr for work that takes long: on a terminal only.
#pragma once

#include <chrono>

namespace hooke {

class ProgressBar {
 public:
  // Of work in `total` parts. Nothing is shown when not `wanted` or stderr is no terminal.
  ProgressBar(long total, bool enabled);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(long done);

 private:
  using Clock = std::chrono::steady_clock;
  long total_;
  bool was_shown_ = false, enabled_;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace hooke
