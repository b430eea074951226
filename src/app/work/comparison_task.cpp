#include "app/work/comparison_task.h"

namespace hooke {

void ComparisonTask::start(const Status& status) {
  if (task_.is_running() || status.snapshot->system->point_count() == 0) return;
  newest_.reset();
  settings_ = status.snapshot->settings;
  task_.start("Comparing methods", [this, snapshot = status.snapshot](const Progress& progress) -> BackgroundTask::Completion {
    constexpr double seconds = 1.0;
    auto result =
        std::make_shared<const MethodComparison>(compare_methods(*snapshot->system, snapshot->state, seconds, comparison_effort, progress));
    return [this, result] { newest_ = result; };
  });
}

ComparisonStatus ComparisonTask::status() const {
  return {.is_running = task_.is_running(),
          .fraction = task_.is_running() ? task_.fraction() : 0.0,
          .seconds = task_.is_running() ? task_.seconds() : 0.0,
          .result = newest_};
}

}  // namespace hooke
