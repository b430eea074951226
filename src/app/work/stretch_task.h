// Computes what stretches some springs of the scene on screen, in a background thread.
#pragma once

#include "app/work/background_task.h"
#include "ui/panels.h"

namespace hooke {

class StretchTask {
 public:
  // Of these springs, in the present state; ends the one before.
  void start(const Status& status, std::vector<SpringId> springs);
  // Once per frame: takes the result.
  void follow() { task_.follow(); }
  bool is_running() const { return task_.is_running(); }
  // For the panel.
  StretchStatus status() const;

 private:
  std::vector<SpringId> springs_;
  std::shared_ptr<const StretchBreakdown> newest_;
  BackgroundTask task_;  // last: the destructor waits for it before anything that it uses is destroyed
};

}  // namespace hooke
