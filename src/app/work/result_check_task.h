// Checks the result of the scene on screen in a background thread: the window never waits for it.
#pragma once

#include "app/work/background_task.h"
#include "ui/panels.h"

namespace hooke {

class ResultCheckTask {
 public:
  // Of the present state, unless one is running.
  void start(const Status& status);
  void stop() {
    if (task_.is_running()) task_.stop();
  }
  // Once per frame: takes the result of a finished check.
  void follow() { task_.follow(); }
  bool is_running() const { return task_.is_running(); }
  // For the panel.
  ResultCheckStatus status() const;

 private:
  std::shared_ptr<const ResultCheck> newest_;
  BackgroundTask task_;  // last: the destructor waits for it before anything that it uses is destroyed
};

}  // namespace hooke
