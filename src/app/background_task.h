// Reading and writing of files on a thread of its own, so that the window never waits for a disk or a large scene.
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
  // What is left to do with the result, in the window's thread.
  using Completion = std::function<void()>;
  // Runs on the other thread; it must throw nothing, and ends early when `progress` says so.
  using Work = std::function<Completion(const Progress& progress)>;

  BackgroundTask() = default;
  ~BackgroundTask();  // stops, and waits
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  // `what` goes on: "Opening sheet.json". Nothing may be going on yet.
  void start(std::string what, Work work);
  // Waits for its end, at most so long, and then does what is left to do. Whether nothing goes on any more.
  bool follow(std::chrono::milliseconds at_most = std::chrono::milliseconds(0));
  void stop() { progress_->stop = true; }

  bool is_running() const { return run_.valid(); }
  // Asked for in the Completion: whether the work had been told to stop.
  bool was_stopped() const { return progress_->stop; }
  const std::string& what() const { return what_; }
  double fraction() const { return progress_->fraction; }
  double seconds() const;  // [s] since its start

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
