// Progress of a benchmark, on one line of a terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace hooke {

// A part is one method on one problem.
class BenchProgress {
 public:
  // Shows nothing unless `enabled` and stderr is a terminal.
  BenchProgress(std::size_t parts, bool enabled);
  ~BenchProgress() { clear(); }
  BenchProgress(const BenchProgress&) = delete;
  BenchProgress& operator=(const BenchProgress&) = delete;

  void begin_part(const std::string& label);
  void show(const std::string& detail) const;
  // A part found in earlier results is excluded from the estimate of the time left.
  void end_part(bool was_measured);
  // Clears its line.
  void clear() const;

 private:
  std::string time_left() const;

  using Clock = std::chrono::steady_clock;
  std::size_t parts_, started_ = 0, measured_ = 0;
  bool enabled_;
  std::string label_;
  Clock::time_point part_start_ = Clock::now();
  Clock::duration spent_{};
};

}  // namespace hooke
