// A progress bar on stderr, on terminals only.
#pragma once

#include <chrono>

namespace hooke {

class ProgressBar {
 public:
  // For work in `total` parts. Shows nothing unless `enabled` and stderr is a terminal.
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
