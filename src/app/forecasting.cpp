#include "app/forecasting.h"

#include <chrono>

namespace hooke {

void Forecasting::follow(const Status& status) {
  if (making_.valid()) {
    if (making_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    Forecast made = making_.get();
    if (!std::exchange(is_of_other_, false)) newest_ = std::move(made);
  }
  const System& system = *status.snapshot->system;
  Of now{status.edits, status.scene_name, system.point_count(), system.spring_count()};
  if (now == of_) return;
  of_ = std::move(now);
  stop_ = false;
  making_ = std::async(std::launch::async, [this, snapshot = status.snapshot, before = newest_] {
    return make_forecast(snapshot->system, snapshot->state, before, stop_);
  });
}

void Forecasting::forget() {
  newest_ = {};
  of_ = {};
  is_of_other_ = making_.valid();
  stop_ = true;
}

}  // namespace hooke
