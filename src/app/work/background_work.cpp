#include "app/work/background_work.h"

namespace hooke {

void BackgroundWork::follow(const Status& status, const Panels& panels, LabThread& lab) {
  const Snapshot& snapshot = *status.snapshot;
  const System& system = *snapshot.system;
  const long edits = status.history.edits;
  forecast.follow(ForecastKey{edits, status.document->name, system.point_count(), system.spring_count()}, [&] {
    return [copy = status.snapshot, before = forecast.newest()](const std::atomic<bool>& stop) {
      return make_forecast(copy->system, copy->state, before, stop);
    };
  });
  crossings.follow(status);

  // while the panel of the accuracy is open
  std::optional<AdviceKey> advice_key;
  if (panels.shown.accuracy && status.run.frames > 0) advice_key = AdviceKey{edits, snapshot.settings, &system};
  advice.follow(advice_key, [&] {
    return [copy = status.snapshot](const std::atomic<bool>& stop) {
      return std::optional(advise_on_cost(*copy->system, copy->state, copy->settings, stop));
    };
  });

  // until the banner of the failure is closed
  std::optional<FailureKey> failure;
  const auto& failed = status.diagnosis.failed;
  if (failed && panels.banners.dismissed != failed->time) failure = FailureKey{failed->time, edits, failed->start.get()};
  remedy.follow(failure, [&] {
    return [this, run = *failed](const std::atomic<bool>& stop) {
      return std::optional(find_remedy(run, stop, [this](const std::string& text) {
        const std::lock_guard lock(test.mutex);
        test.text = text;
      }));
    };
  });
  comparison.follow();
  result_check.follow();
  stretch.follow();
  ghosts.follow(status, lab);
}

void BackgroundWork::start_comparison(const Status& status) {
  constexpr double seconds = 1.0;
  if (status.snapshot->system->point_count() == 0) return;
  comparison.start([snapshot = status.snapshot](const Progress& progress) {
    return compare_methods(*snapshot->system, snapshot->state, seconds, comparison_effort, progress, snapshot->settings.frame_rate);
  });
}

void BackgroundWork::start_result_check(const Status& status) {
  // the equilibrium of the forecast is an initial guess
  result_check.start([snapshot = status.snapshot, guess = forecast.newest()](const Progress& progress) {
    return check_result(*snapshot->system, snapshot->state, snapshot->settings, default_check_seconds, progress, guess);
  });
}

void BackgroundWork::start_stretch(const Status& status, const std::vector<SpringId>& springs) {
  stretch.start([snapshot = status.snapshot, springs](const Progress& progress) {
    return explain_stretch(*snapshot->system, snapshot->state, snapshot->settings, springs, progress);
  });
}

void BackgroundWork::clear(const Status& status, LabThread& lab) {
  forecast.clear();
  ghosts.set({}, status, lab);
  comparison.clear();
  result_check.clear();
  stretch.clear();
}

BackgroundResults BackgroundWork::results() const {
  RemedyStatus of_failure{.test = {}, .found = remedy.newest()};
  if (remedy.is_running() && !remedy.is_stopped()) {
    const std::lock_guard lock(test.mutex);
    of_failure.test = test.text;
  }
  return {&forecast.newest(), advice.newest(), of_failure, comparison.status(), result_check.status(), stretch.status()};
}

}  // namespace hooke
