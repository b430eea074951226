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

  // `what`: "Opening sheet.json". Waits briefly, so that short operations finish before it returns. Returns false, without starting this
  // one, if another one is running.
  bool start(std::string what, BackgroundTask::Work work);
  // Once per frame.
  void update() { update(std::chrono::milliseconds(0)); }
  void wait();
  void stop() { task_.stop(); }

  bool is_running() const { return task_.is_running(); }
  // For completions: whether the operation was canceled.
  bool was_stopped() const { return task_.was_stopped(); }
  FileWork progress() const;

  void set_patience(std::chrono::milliseconds patience) { patience_ = patience; }

 private:
  void update(std::chrono::milliseconds max_wait);

  Panels& panels_;
  std::chrono::milliseconds patience_{80};
  BackgroundTask task_;  // last: the destructor waits for it before anything that it uses is destroyed
};

}  // namespace hooke
