#include "app/work/remedy_search.h"

#include <chrono>

namespace hooke {

void RemedySearch::follow(const Status& status, bool is_wanted) {
  std::optional<FailureKey> key;
  if (const auto& failed = status.diagnosis.failed; failed && is_wanted)
    key = FailureKey{failed->time, status.history.edits, failed->start.get()};
  if (key != key_) {
    stop();
    shown_ = {};
  }

  if (pending_.valid()) {
    const bool is_stopped = search_->stop;
    if (pending_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
      const Remedy found = pending_.get();
      if (!is_stopped) shown_ = {.test = {}, .found = found};
    } else if (!is_stopped) {
      const std::lock_guard lock(search_->mutex);
      shown_.test = search_->test;
    }
  }

  // the next search waits for the end of the one that was canceled
  if (key == key_ || pending_.valid()) return;
  key_ = key;
  if (key) start(*status.diagnosis.failed);
}

void RemedySearch::stop() {
  if (search_) search_->stop = true;
}

void RemedySearch::start(const FailedRun& run) {
  search_ = std::make_shared<Search>();
  pending_ = std::async(std::launch::async, [run, search = search_] {
    return find_remedy(run, search->stop, [&](const std::string& test) {
      const std::lock_guard lock(search->mutex);
      search->test = test;
    });
  });
}

}  // namespace hooke
