#include "app/work/scene_tasks.h"

namespace hooke {

void start_comparison(ResultTask<MethodComparison>& task, const Status& status) {
  constexpr double seconds = 1.0;
  if (status.snapshot->system->point_count() == 0) return;
  task.start("Comparing methods", [snapshot = status.snapshot](const Progress& progress) {
    return compare_methods(*snapshot->system, snapshot->state, seconds, comparison_effort, progress, snapshot->settings.frame_rate);
  });
}

void start_result_check(ResultTask<ResultCheck>& task, const Status& status, const Forecast& forecast) {
  task.start("Checking the result", [snapshot = status.snapshot, forecast](const Progress& progress) {
    return check_result(*snapshot->system, snapshot->state, snapshot->settings, default_check_seconds, progress, forecast);
  });
}

void start_stretch(ResultTask<StretchBreakdown>& task, const Status& status, const std::vector<SpringId>& springs) {
  task.start("Explaining the stretch", [snapshot = status.snapshot, springs](const Progress& progress) {
    return explain_stretch(*snapshot->system, snapshot->state, snapshot->settings, springs, progress);
  });
}

}  // namespace hooke
