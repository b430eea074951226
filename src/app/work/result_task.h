// Computes one result in a background thread: the window never waits for it.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "app/work/background_task.h"
#include "ui/panels.h"

namespace hooke {

template <class Result>
class ResultTask {
 public:
  using Compute = std::function<Result(const Progress&)>;

  // Does nothing while one is running. `compute` must not throw, and ends early if its progress returns false.
  void start(Compute compute) {
    if (is_running()) return;
    newest_.reset();
    next_ = std::move(compute);
    start_next();
  }
  void stop() {
    next_ = {};
    if (task_.is_running()) task_.stop();
  }
  // When another scene is shown: the result, or the computation in progress, is about the previous one.
  void clear() {
    stop();
    newest_.reset();
    is_outdated_ = task_.is_running();
  }
  // Once per frame: takes the result.
  void follow() {
    if (task_.follow()) start_next();
  }
  bool is_running() const { return next_ || (task_.is_running() && !is_outdated_); }
  // For the panel.
  ResultStatus<Result> status() const {
    const bool is_computed = task_.is_running() && !is_outdated_;
    return {.is_running = is_running(),
            .fraction = is_computed ? task_.fraction() : 0.0,
            .seconds = is_computed ? task_.seconds() : 0.0,
            .result = newest_};
  }

 private:
  // At once, or when the outdated computation has stopped.
  void start_next() {
    if (task_.is_running() || !next_) return;
    is_outdated_ = false;
    task_.start({}, [this, compute = std::exchange(next_, {})](const Progress& progress) -> BackgroundTask::Completion {
      auto result = std::make_shared<const Result>(compute(progress));
      return [this, result] {
        if (!is_outdated_) newest_ = result;
      };
    });
  }

  Compute next_;
  bool is_outdated_ = false;  // the computation in progress
  std::shared_ptr<const Result> newest_;
  BackgroundTask task_;  // last: the destructor waits for it before anything that it uses is destroyed
};

}  // namespace hooke
