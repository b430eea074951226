#include "app/work/result_check_task.h"

namespace hooke {

void ResultCheckTask::start(const Status& status) {
  if (task_.is_running()) return;
  newest_.reset();
  task_.start("Checking the result", [this, snapshot = status.snapshot](const Progress& progress) -> BackgroundTask::Completion {
    auto result = std::make_shared<const ResultCheck>(
        check_result(*snapshot->system, snapshot->state, snapshot->settings, default_check_seconds, progress));
    return [this, result] { newest_ = result; };
  });
}

ResultCheckStatus ResultCheckTask::status() const {
  return {.is_running = task_.is_running(),
          .fraction = task_.is_running() ? task_.fraction() : 0.0,
          .seconds = task_.is_running() ? task_.seconds() : 0.0,
          .result = newest_};
}

}  // namespace hooke
