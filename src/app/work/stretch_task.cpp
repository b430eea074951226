#include "app/work/stretch_task.h"

#include <utility>

namespace hooke {

void StretchTask::start(const Status& status, std::vector<SpringId> springs) {
  if (task_.is_running()) return;
  newest_.reset();
  springs_ = std::move(springs);
  task_.start("Explaining the stretch", [this, snapshot = status.snapshot, springs = springs_](const Progress& progress) {
    auto result = std::make_shared<const StretchBreakdown>(
        explain_stretch(*snapshot->system, snapshot->state, snapshot->settings, springs, progress));
    return BackgroundTask::Completion([this, result] { newest_ = result; });
  });
}

StretchStatus StretchTask::status() const {
  return {.is_running = task_.is_running(),
          .fraction = task_.is_running() ? task_.fraction() : 0.0,
          .seconds = task_.is_running() ? task_.seconds() : 0.0,
          .springs = springs_,
          .result = newest_};
}

}  // namespace hooke
