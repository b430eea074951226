// Looks for a remedy of a run that diverged, on copies in a background thread: the window never waits for it.
#pragma once

#include <atomic>
#include <future>
#include <memory>
#include <mutex>
#include <optional>

#include "ui/panels.h"

namespace hooke {

class RemedySearch {
 public:
  ~RemedySearch() { stop(); }

  // Once per frame: starts a search when a run has failed, takes its result, and cancels it when there is no failure any more, when the
  // scene is edited, or when `is_wanted` is false.
  void follow(const Status& status, bool is_wanted);
  bool is_running() const { return pending_.valid(); }
  const RemedyStatus& status() const { return shown_; }

 private:
  // Shared with the thread of one search.
  struct Search {
    std::atomic<bool> stop = false;
    std::mutex mutex;
    std::string test;  // guarded by mutex
  };
  // Identifies the failure.
  struct FailureKey {
    double time = 0.0;
    long edits = 0;
    const Scene* start = nullptr;
    bool operator==(const FailureKey&) const = default;
  };
  void stop();
  void start(const FailedRun& run);

  std::optional<FailureKey> key_;  // of the search in progress or of the result shown
  RemedyStatus shown_;
  std::shared_ptr<Search> search_;
  std::future<Remedy> pending_;  // last: it is waited for before anything that it uses is destroyed
};

}  // namespace hooke
