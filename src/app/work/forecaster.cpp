#include "app/work/forecaster.h"

#include <chrono>

namespace hooke {

void Forecaster::follow(const Status& status) {
  if (pending_.valid()) {
    if (pending_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    Forecast made = pending_.get();
    if (!std::exchange(is_stale_, false)) newest_ = std::move(made);
  }
  const System& system = *status.snapshot->system;
  ForecastKey now{status.history.edits, status.document->name, system.point_count(), system.spring_count()};
  if (now == key_) return;
  key_ = std::move(now);
  stop_ = false;
  pending_ = std::async(std::launch::async, [this, snapshot = status.snapshot, before = newest_] {
    return make_forecast(snapshot->system, snapshot->state, before, stop_);
  });
}

void Forecaster::clear() {
  newest_ = {};
  key_ = {};
  is_stale_ = pending_.valid();
  stop_ = true;
}

}  // namespace hooke
