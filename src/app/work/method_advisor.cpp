#include "app/work/method_advisor.h"

#include <chrono>

namespace hooke {

void MethodAdvisor::follow(const Status& status, bool is_wanted) {
  const Snapshot& snapshot = *status.snapshot;
  Key now{status.history.edits, snapshot.settings, snapshot.system.get()};
  const bool is_current = now == key_;
  if (!is_current) newest_.reset();
  if (!is_current || !is_wanted) stop_ = true;
  if (pending_.valid()) {
    if (pending_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    auto found = pending_.get();
    if (is_current && !stop_) newest_ = found;
  }
  if (is_current || !is_wanted || status.run.frames == 0) return;
  key_ = now;
  stop_ = false;
  pending_ = std::async(std::launch::async,
                        [this, copy = status.snapshot] { return advise_on_cost(*copy->system, copy->state, copy->settings, stop_); });
}

}  // namespace hooke
