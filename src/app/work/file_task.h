// The file operation in progress: one at a time, in the background, with a progress dialog when it takes long.
#pragma once

#include <chrono>
#include <string>

#include "app/work/background_task.h"
#include "ui/panels.h"

namespace hooke {

class FileTask {
 public:
  explicit FileTask(Panels& panels) : panels_(panels) {}

  // `what`: "Opening sheet.json". Waits for a moment: short operations finish before it returns. False: another one is running,
  // and this one is not started.
  bool start(std::string what, BackgroundTask::Work work);
  // Once per frame.
  void update() { update(std::chrono::milliseconds(0)); }
  void wait();
  void stop() { task_.stop(); }

  bool is_running() const { return task_.is_running(); }
  // For completions: whether the operation was cancelled.
  bool was_stopped() const { return task_.was_stopped(); }
  FileWork progress() const;

  void set_patience(std::chrono::milliseconds patience) { patience_ = patience; }

 private:
  void update(std::chrono::milliseconds at_most);

  Panels& panels_;
  std::chrono::milliseconds patience_{80};
  BackgroundTask task_;  // last: it is waited for before anything that it uses is destroyed
};

}  // namespace hooke
