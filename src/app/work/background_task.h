// An operation in a background thread, such as reading or writing a file, so that the window never waits for it.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <string>

#include "base/progress.h"

namespace hooke {

class BackgroundTask {
 public:
  // Runs on the thread of the window when the work is done.
  using Completion = std::function<void()>;
  // Runs on the background thread. It must not throw, and ends early if `progress` returns false.
  using Work = std::function<Completion(const Progress& progress)>;

  BackgroundTask() = default;
  ~BackgroundTask();  // stops the work and waits for it
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  // `what`: "Opening sheet.json". No work may be in progress.
  void start(std::string what, Work work);
  // Waits up to `max_wait` for the end of the work, and then runs its completion. Returns true if no work is in progress afterwards.
  bool follow(std::chrono::milliseconds max_wait = std::chrono::milliseconds(0));
  void stop() { progress_->stop = true; }

  bool is_running() const { return run_.valid(); }
  // For completions: whether stop() was called.
  bool was_stopped() const { return progress_->stop; }
  const std::string& what() const { return what_; }
  double fraction() const { return progress_->fraction; }
  double seconds() const;  // [s] since the start

 private:
  struct Progress {
    std::atomic<double> fraction = 0.0;
    std::atomic<bool> stop = false;
  };
  std::shared_ptr<Progress> progress_ = std::make_shared<Progress>();
  std::string what_;
  std::chrono::steady_clock::time_point started_{};
  std::future<Completion> run_;
};

}  // namespace hooke
